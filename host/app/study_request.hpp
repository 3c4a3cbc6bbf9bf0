// From the command line of `study` to what is studied.
#pragma once

#include "app/options.hpp"

namespace causticl {

StudyRequest study_request(const Options& options);

}  // namespace causticl

// Ctrl-C and SIGTERM as a question that the pass loop can ask.
#pragma once

namespace causticl {

/// From here on the first SIGINT or SIGTERM is remembered, and said on stderr unless `quiet`; the second one
/// ends the process at once.
void interruption_listen(bool quiet);

/// Has there been one?
bool interruption_requested();

}  // namespace causticl

// Ctrl-C, SIGTERM and SIGHUP as a question that the pass loop can ask.
#pragma once

namespace causticl {

/// From here on the first SIGINT, SIGTERM or SIGHUP is remembered, and said on stderr unless `quiet`; a
/// second SIGINT or SIGTERM ends the process at once. A SIGHUP that the process was started to ignore stays
/// ignored.
void interruption_listen(bool quiet);

/// Has there been one?
bool interruption_requested();

}  // namespace causticl

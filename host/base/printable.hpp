// Text of files, devices and names made safe for a terminal.
#pragma once

#include <string>

namespace causticl {

/// `text` with `?` for every byte or character that a terminal or an editor might act upon: control
/// characters (C0 but for line breaks, DEL, C1), line and paragraph separators, those that turn the direction
/// of text, and bytes that are no UTF-8. Words of more than 1000 bytes lose their middle, lines of more than
/// 8000 their end.
std::string printable(const std::string& text);

/// The same without line breaks.
std::string printable_line(const std::string& text);

/// Whether printable_line() would replace any character.
bool has_control_characters(const std::string& text);

}  // namespace causticl

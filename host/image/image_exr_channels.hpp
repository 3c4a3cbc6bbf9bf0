// Which channels of an EXR file are its picture.
#pragma once

#include <ImfChannelList.h>

#include <array>
#include <string>
#include <vector>

namespace causticl {

struct ExrChannels {
  std::array<std::string, 4> names;  // of red, green, blue and alpha; empty where there is none
  bool is_grey = false;              // names[0] is luminance, or the one channel that there is
  std::vector<std::string> notes;    // for the user
};

/// R, G, B and A; or Y or any channel that stands alone, as grey; or those of the one layer ("diffuse.R")
/// that has such channels. Lower case and whole words are names too. Throws std::runtime_error with the names
/// of the channels where none, or several layers, could be meant.
ExrChannels choose_exr_channels(const Imf::ChannelList& list);

}  // namespace causticl

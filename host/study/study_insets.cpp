#include "study/study_insets.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "image/image_formats.hpp"
#include "study/study_session.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string data_uri(const Picture& picture) {
  return "data:image/png;base64," + base64(encode_png(picture));
}

Picture cut_out(const Picture& picture, const Inset& inset) {
  Picture result{inset.size, inset.size, {}};
  for (int y = 0; y < inset.size; ++y) {
    const auto row = picture.rgb.begin() + 3 * ((inset.y + y) * picture.width + inset.x);
    result.rgb.insert(result.rgb.end(), row, row + 3 * inset.size);
  }
  return result;
}

float seen(float value) { return std::pow(value > 0 ? std::min(value, 1.0f) : 0.0f, 1 / 2.2f); }

/// The squared difference of each pixel from the reference as a PNG shows both, summed over pictures.
std::vector<double> visible_differences(const Picture& reference, const std::vector<Picture>& pictures) {
  std::vector<double> result(reference.rgb.size() / 3);
  for (const Picture& picture : pictures)
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
      const double difference = seen(picture.rgb[i]) - seen(reference.rgb[i]);
      result[i / 3] += difference * difference;
    }
  return result;
}

}  // namespace

std::vector<Inset> choose_insets(const Picture& reference, const std::vector<Picture>& pictures,
                                 std::size_t count) {
  const int width = reference.width, height = reference.height;
  const int size = std::clamp(std::min(width, height) / 4, std::min({12, width, height}), 64);
  const int step = std::max(1, size / 4);
  const std::vector<double> differences = visible_differences(reference, pictures);
  std::vector<std::pair<double, Inset>> candidates;
  for (int y = 0; y + size <= height; y += step)
    for (int x = 0; x + size <= width; x += step) {
      double sum = 0;
      for (int v = y; v < y + size; ++v)
        for (int u = x; u < x + size; ++u) sum += differences[static_cast<std::size_t>(v * width + u)];
      candidates.push_back({sum, {x, y, size}});
    }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Inset> chosen;
  for (const auto& [sum, inset] : candidates) {
    const bool overlaps = std::any_of(chosen.begin(), chosen.end(), [&, at = inset](const Inset& other) {
      return std::abs(other.x - at.x) < size && std::abs(other.y - at.y) < size;
    });
    if (!overlaps && chosen.size() < count) chosen.push_back(inset);
  }
  return chosen;
}

std::string study_insets(const std::string& folder, const Study& study) {
  const std::string reference_file = study.given_reference.empty()
                                         ? (fs::path(folder) / "reference.exr").string()
                                         : study.given_reference.substr(0, study.given_reference.rfind(' '));
  std::vector<Picture> pictures;
  std::vector<std::string> names;
  const Picture reference = read_picture(reference_file);
  for (const StudySetting& setting : study.settings) {
    const std::string file = (fs::path(folder) / picture_name(setting)).string();
    if (!study.run(setting, study.seed, false) || !fs::exists(file)) continue;
    pictures.push_back(read_picture(file));
    names.push_back(setting.id());
  }
  const auto insets = choose_insets(reference, pictures, 3);
  const auto cuts_of = [&](const Picture& picture) {
    Json cuts = Json::array();
    for (const Inset& inset : insets) cuts.push_back(data_uri(cut_out(picture, inset)));
    return cuts;
  };
  Json places = Json::array(), of_settings = Json::object();
  for (const Inset& inset : insets) places.push_back({{"x", inset.x}, {"y", inset.y}, {"size", inset.size}});
  for (std::size_t i = 0; i < pictures.size(); ++i) of_settings[names[i]] = cuts_of(pictures[i]);
  const Json json = {{"whole", data_uri(reference)},
                     {"places", places},
                     {"reference", cuts_of(reference)},
                     {"settings", of_settings}};
  return json.dump();
}

}  // namespace causticl

// What the readers of all scene formats share: the scene as it grows, the files that it names, and notices.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/source_location.hpp"
#include "format/asset_file.hpp"
#include "image/image_limits.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// The scene under construction, and what has been loaded for it.
struct SceneBuilder {
  Scene scene;
  std::map<std::pair<std::string, bool>, int> images;  // resolved path and srgb, into scene.images
  std::map<std::string, int> meshes;                   // resolved path, into scene.meshes
  std::map<int, int> turned_meshes;                    // of those that are glass: the one to take
  std::set<std::string> said;                          // texts of notices so far
  ImageLimits image_limits;                            // what is left for further images

  /// Tells the user `text`, with the place where it came up first.
  void notice(const SourceLocation& where, const std::string& text);
  /// Tells the user what was found in a file.
  void file_notes(const SourceLocation& where, const std::string& file,
                  const std::vector<std::string>& notes);
  /// Index of the image or mesh that `path` names; each file is read once.
  int image(const AssetName& path, bool srgb);
  int mesh(const AssetName& path);
  /// The mesh to take for a closed body of glass: where `mesh` is wound inwards, one that is turned.
  int mesh_of_glass(const SourceLocation& object, int mesh);
  /// The image that `path` names as radiance: linear, as bright as it is, and black where it is none.
  Image radiance_map(const AssetName& path);
  /// The last step of every reader: moves emitters out of surfaces that they lie flush with, and tells of a
  /// scene without light. `whole` is where the scene begins.
  void finish(const SourceLocation& whole);
};

}  // namespace causticl

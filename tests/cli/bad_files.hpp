// Scenes that must be refused: meshes, images and whole scene files.
#pragma once

#include "bad_scene.hpp"

namespace causticl {

inline constexpr BadScene bad_files[] = {
    {"missing mesh", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"nowhere.obj\"",
     "scene.json:7: /objects/0/path: expected a file that exists, got \"nowhere.obj\"; relative paths are "
     "looked up beside the scene file, then in the working directory"},
    {"mesh without name", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"\"",
     "scene.json:7: /objects/0/path: expected the path of a file, got \"\""},
    {"mesh name with a NUL", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"a\\u0000.obj\"",
     "scene.json:7: /objects/0/path: expected the path of a file, got \"a\\u0000.obj\""},
    {"folder as a mesh", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \".\"",
     "scene.json:7: /objects/0/path: expected a file, got \".\"; that is a directory"},
    {"unknown mesh format", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"good.json\"",
     "scene.json:7: /objects/0/path: good.json: is no mesh by its name; expected the extension .obj or .ply"},
    {"unknown tree_type", "\"type\": \"rectangle\"",
     "\"type\": \"mesh\", \"path\": \"no_face.obj\", \"tree_type\": \"Octree\"",
     "scene.json:7: /objects/0/tree_type: expected \"KDTree\", \"BSPTree\" or \"MyTree\", got \"Octree\"; "
     "did you mean \"KDTree\"?"},
    {"body cut.ply", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"body_cut.ply\"",
     "scene.json:7: /objects/0/path: body_cut.ply: face 0: list 'vertex_indices' has 3 entries, more than "
     "the rest of the file holds"},
    {"coordinate huge.obj", "\"type\": \"rectangle\"",
     "\"type\": \"mesh\", \"path\": \"coordinate_huge.obj\"",
     "scene.json:7: /objects/0/path: coordinate_huge.obj:2: '1e999' is not a finite number"},
    {"coordinate missing.obj", "\"type\": \"rectangle\"",
     "\"type\": \"mesh\", \"path\": \"coordinate_missing.obj\"",
     "scene.json:7: /objects/0/path: coordinate_missing.obj:2: 'v' has 2 numbers; expected 3"},
    {"coordinate nan.obj", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"coordinate_nan.obj\"",
     "scene.json:7: /objects/0/path: coordinate_nan.obj:2: 'nan' is not a finite number"},
    {"coordinate nan.ply", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"coordinate_nan.ply\"",
     "scene.json:7: /objects/0/path: coordinate_nan.ply: vertex 1: a coordinate is not a finite number"},
    {"empty.obj", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"empty.obj\"",
     "scene.json:7: /objects/0/path: empty.obj: is empty; expected a mesh"},
    {"garbage.obj", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"garbage.obj\"",
     "scene.json:7: /objects/0/path: garbage.obj:1: '??M??%0??m?,??#{.???r???q?D??I<?...' is not an OBJ "
     "statement; is this a text file in OBJ format?"},
    {"header cut.ply", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"header_cut.ply\"",
     "scene.json:7: /objects/0/path: header_cut.ply:5: the file ends within its header; expected end_header"},
    {"index negative.obj", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"index_negative.obj\"",
     "scene.json:7: /objects/0/path: index_negative.obj:4: vertex index -4 is out of range; 3 are defined up "
     "to here"},
    {"index too large.obj", "\"type\": \"rectangle\"",
     "\"type\": \"mesh\", \"path\": \"index_too_large.obj\"",
     "scene.json:7: /objects/0/path: index_too_large.obj:4: vertex index 4 is out of range; 3 are defined in "
     "the file"},
    {"index too large.ply", "\"type\": \"rectangle\"",
     "\"type\": \"mesh\", \"path\": \"index_too_large.ply\"",
     "scene.json:7: /objects/0/path: index_too_large.ply:13: face 0: vertex index 3 is out of range; there "
     "are 3 vertices"},
    {"index zero.obj", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"index_zero.obj\"",
     "scene.json:7: /objects/0/path: index_zero.obj:4: vertex index 0 is out of range; 3 are defined up to "
     "here"},
    {"no face.obj", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"no_face.obj\"",
     "scene.json:7: /objects/0/path: no_face.obj: has no faces (3 vertices); expected a mesh"},
    {"two corners.obj", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"two_corners.obj\"",
     "scene.json:7: /objects/0/path: two_corners.obj:4: the face has 2 corners; expected at least 3"},
    {"unknown format.ply", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"unknown_format.ply\"",
     "scene.json:7: /objects/0/path: unknown_format.ply:2: unknown format 'ascii_1.0'; expected ascii, "
     "binary_little_endian or binary_big_endian"},
    {"vertices missing.ply", "\"type\": \"rectangle\"",
     "\"type\": \"mesh\", \"path\": \"vertices_missing.ply\"",
     "scene.json:7: /objects/0/path: vertices_missing.ply: the header declares 1000000000 of element "
     "'vertex', but only 6 bytes follow; is the file truncated?"},
    {"wrong magic.ply", "\"type\": \"rectangle\"", "\"type\": \"mesh\", \"path\": \"wrong_magic.ply\"",
     "scene.json:7: /objects/0/path: wrong_magic.ply:1: expected 'ply' on the first line; is this a PLY "
     "file?"},
    {"missing image", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"nowhere.png\"}",
     "scene.json:5: /materials/white/color/path: expected a file that exists, got \"nowhere.png\"; relative "
     "paths are looked up beside the scene file, then in the working directory"},
    {"folder as an image", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"..\"}",
     "scene.json:5: /materials/white/color/path: expected a file, got \"..\"; that is a directory"},
    {"cut.exr", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"cut.exr\"}",
     "scene.json:5: /materials/white/color/path: cut.exr: cannot be decoded: the file ends early; is it "
     "truncated?"},
    {"cut.png", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"cut.png\"}",
     "scene.json:5: /materials/white/color/path: cut.png: cannot be decoded: it ends early; is it "
     "truncated?"},
    {"empty.png", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"empty.png\"}",
     "scene.json:5: /materials/white/color/path: empty.png: is empty; expected an image"},
    {"garbage.jpg", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"garbage.jpg\"}",
     "scene.json:5: /materials/white/color/path: garbage.jpg: cannot be decoded: unknown marker"},
    {"huge size.png", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"huge_size.png\"}",
     "scene.json:5: /materials/white/color/path: huge_size.png: cannot be decoded: 2147483647x2147483647 "
     "pixels "
     "are too many; at most 2^28 are read"},
    {"wrong magic.png", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"wrong_magic.png\"}",
     "scene.json:5: /materials/white/color/path: wrong_magic.png: cannot be decoded: expected PNG, JPEG, "
     "BMP, TGA, HDR, PFM or EXR"},
    {"zero size.png", "[0.8, 0.8, 0.8]", "{\"type\": \"image\", \"path\": \"zero_size.png\"}",
     "scene.json:5: /materials/white/color/path: zero_size.png: cannot be decoded: 0-pixel image"},
    {"blank.json", "FILE", "blank.json", "blank.json:1: expected a scene, got an empty file"},
    {"bom then cut.json", "FILE", "bom_then_cut.json",
     "bom_then_cut.json:3: expected a value, got the end of the file; it is cut short or a bracket is not "
     "closed"},
    {"comment only.json", "FILE", "comment_only.json",
     "comment_only.json:1: expected a value, got the end of the file; it is cut short or a bracket is not "
     "closed"},
    {"deep.json", "FILE", "deep.json", "deep.json:2: expected at most 64 levels of nesting, got more"},
    {"empty.json", "FILE", "empty.json", "empty.json:1: expected a scene, got an empty file"},
    {"garbage.json", "FILE", "garbage.json", "garbage.json: expected a scene in JSON, got binary data"},
    {"ill formed utf8.json", "FILE", "ill_formed_utf8.json",
     "ill_formed_utf8.json:2: malformed string: ill-formed UTF-8 byte"},
    {"no scene", "FILE", "garbage.obj",
     "garbage.obj: is no scene of a known format; expected CaustiCL JSON (.json)"},
    {"not an object.json", "FILE", "not_an_object.json",
     "not_an_object.json:1: /: expected an object, got a list of 3"},
    {"utf16.json", "FILE", "utf16.json", "utf16.json: expected a scene in JSON, got binary data"},
};

}  // namespace causticl

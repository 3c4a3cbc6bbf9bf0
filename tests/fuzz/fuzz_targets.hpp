// Fuzz targets: each reads bytes as one kind of file and checks what the readers promise. The fuzzers and the
// tests run the same functions.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace causticl {

/// A promise that a reader broke. Only a fault of the program throws it: the input may be anything.
struct BrokenPromise : std::logic_error {
  using std::logic_error::logic_error;
};

struct FuzzTarget {
  const char* name;  // also of its corpus and its dictionary
  /// Reads `bytes`. Returns where they load, and where the reader refuses them with one line. Throws whatever
  /// else happens.
  void (*run)(const std::string& bytes);
};

/// All targets, in the order of scripts/fuzz.sh's table.
const std::vector<FuzzTarget>& fuzz_targets();

/// The target of this name. Throws std::out_of_range.
const FuzzTarget& fuzz_target(const std::string& name);

// The targets, one kind of reader a file.
void fuzz_scene(const std::string& bytes);
void fuzz_override(const std::string& bytes);
void fuzz_obj(const std::string& bytes);
void fuzz_ply(const std::string& bytes);
void fuzz_png(const std::string& bytes);
void fuzz_jpeg(const std::string& bytes);
void fuzz_hdr(const std::string& bytes);
void fuzz_bmp(const std::string& bytes);
void fuzz_tga(const std::string& bytes);
void fuzz_pfm(const std::string& bytes);
void fuzz_exr(const std::string& bytes);
void fuzz_kernels(const std::string& bytes);
void fuzz_study(const std::string& bytes);
void fuzz_film(const std::string& bytes);

}  // namespace causticl

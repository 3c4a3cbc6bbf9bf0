// An entry of the kernel store as bytes: what was compiled of one program, behind a checksum.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace causticl {

/// A file that a driver made of a program: its path in the driver's folder, or any name that the caller
/// knows.
struct KernelFile {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// What was compiled of one program.
using KernelFiles = std::vector<KernelFile>;

/// XXH3 of 128 bits, in the order of bytes that is the same on every machine.
std::array<std::uint8_t, 16> checksum(const void* data, std::size_t size);

/// Whether the name of a file stays in the folder that it is put in: names joined by `/`, none of them empty,
/// `.` or `..`, without control characters.
bool is_name_within(const std::string& name);

std::string pack_kernels(const KernelFiles& files);

/// What pack_kernels() was given; nothing where the checksum does not hold, the bytes do not come out even,
/// or a name is not within its folder.
std::optional<KernelFiles> unpack_kernels(const std::vector<std::uint8_t>& bytes);

}  // namespace causticl

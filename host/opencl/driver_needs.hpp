// What drivers need of the system, looked at before they are called: some end the process where it is
// missing.
#pragma once

namespace causticl {

/// Throws DeviceError where PoCL is installed and would not find what it needs: /sys, which tells it of
/// processors and memory, or address space for its compiler.
void check_driver_needs();

}  // namespace causticl

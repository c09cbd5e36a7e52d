#pragma once

#include <string>
#include <vector>

namespace pl {

/// Instruction sets that both this build and this host have, best first ("AVX3", "AVX2", ...); the
/// last one needs nothing beyond the compiler's baseline. The best is in use unless told otherwise.
std::vector<std::string> simd_targets();

/// Makes every frame function of the process use one of simd_targets(), or the best again with "".
/// No result depends on it. False, and nothing changes, if the name is not among them.
bool use_simd_target(const std::string& name);

}  // namespace pl

#include <pl/common/simd_target.h>

#include <hwy/targets.h>
#include <cstdint>

namespace pl {

namespace {

/// One bit each, best first; unaffected by an earlier choice.
const std::vector<std::int64_t>& available() {
  static const std::vector<std::int64_t> bits = hwy::SupportedAndGeneratedTargets();
  return bits;
}

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (std::int64_t target : available()) names.emplace_back(hwy::TargetName(target));
  return names;
}

bool use_simd_target(const std::string& name) {
  std::int64_t chosen = 0;  // Highway's own choice
  for (std::int64_t target : available()) {
    if (name == hwy::TargetName(target)) chosen = target;
  }
  if (chosen == 0 && !name.empty()) return false;
  hwy::SetSupportedTargetsForTest(chosen);
  return true;
}

}  // namespace pl

#include <chip/system/designs.h>
#include <marker/designs/marker/marker_design.h>

namespace platform {

// What the thesis compares itself with. Its program does not need the logic, which is left
// unconfigured on the chip: it draws no power and takes no resources. It is there all the same,
// so that one configuration is good for both.
const DesignInfo& ps_only_design() {
  static const DesignInfo info{
      "ps-only",
      "everything on the PS, the PL left unconfigured: what the thesis compares itself with",
      {"ps-only"},
      false,
      marker_words,
      make_marker_design};
  return info;
}

}  // namespace platform

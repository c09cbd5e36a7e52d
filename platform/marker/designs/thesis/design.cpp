#include <chip/system/designs.h>
#include <marker/designs/marker/marker_design.h>

namespace platform {

// The logic finds corners and blobs, software makes markers of them.
const DesignInfo& thesis_design() {
  static const DesignInfo info{
      "thesis",     "features from the PL, markers from the PS: the hybrid system of the thesis",
      {"hybrid"},   true,
      marker_words, make_marker_design};
  return info;
}

}  // namespace platform

#include <designs/designs.h>
#include <designs/improved/improved_design.h>

namespace platform {

// The improved design in another size: nothing else differs, not even the program.
const DesignInfo& hd_design() {
  static const DesignInfo info{"hd",
                               "the improved design for frames of 1280x720",
                               {"improved"},
                               true,
                               improved_words,
                               [](const char* name, PlPorts& ports) -> std::unique_ptr<Design> {
                                 return std::make_unique<ImprovedDesign>(
                                     name, ports, ImprovedDesign::usual_geometry(1280, 720));
                               }};
  return info;
}

}  // namespace platform

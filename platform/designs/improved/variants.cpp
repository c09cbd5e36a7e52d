#include <designs/designs.h>
#include <designs/improved/improved_design.h>

// The improved design for other ends: its logic and its program, other sizes and settings.
namespace platform {

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

// What `markervp explore sixty-fps` finds.
const DesignInfo& eco_design() {
  static const DesignInfo info{"eco",
                               "the improved design with the least energy at 60 images a second",
                               {"improved"},
                               true,
                               improved_words,
                               improved_design().make,
                               {{"camera.rate", "60 fps"},
                                {"ps.fclk_clk0.frequency", "25 MHz"},
                                {"ps.cpu_clk.frequency", "333.333333 MHz"},
                                {"power.ddr.width", "16"},
                                {"power.ddr.frequency", "400 MHz"},
                                {"power.ddr.voltage", "1.35 V"}}};
  return info;
}

}  // namespace platform

// The thesis' marker detector, and RTL of its own beside it: registers, a memory master, an
// interrupt, a stream that ends where it begins.
#include <axi/rtl_part.h>
#include <chip/system/design_plugin.h>
#include <marker/designs/marker/marker_design.h>

namespace {

class WithRtl : public platform::MarkerDesign {
 public:
  WithRtl(sc_core::sc_module_name name, platform::PlPorts& ports)
      : MarkerDesign(name, ports), copier_("copier", EVERYTHING, {{"ap_clk", &ports.fclk_clk(0)}}) {
    copier_.input("ap_rst_n", proc_sys_reset.peripheral_aresetn);
    axi_interconnect.map("copier", 0x43C0'0000, 0x1'0000)
        .bind(copier_.slave("s_axi_control").socket);
    axi::PinsToTlm& memory = copier_.master("m_axi_gmem");
    axi_mem_interconnect.connect(memory.read, memory.write);
    concat.connect_interrupt(copier_.output<bool>("interrupt"), 63);
    copier_.leave_open("in");
    copier_.leave_open("out");
    copier_.tie("mode", 3);
  }

 private:
  axi::RtlPart copier_;
};

const platform::DesignInfo& info() {
  static const platform::DesignInfo with_rtl{
      "rtl_part",
      "the marker detector, and RTL that copies",
      {"rtl_copying"},
      true,
      platform::marker_words,
      [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
        return std::make_unique<WithRtl>(name, ports);
      }};
  return with_rtl;
}

}  // namespace

MARKERVP_DESIGN(info)

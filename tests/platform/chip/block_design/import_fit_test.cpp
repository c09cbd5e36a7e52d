// Whether a part of a hand-off is as its model is.
#include <chip/block_design/design_file.h>
#include <chip/block_design/import_design.h>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>

#include "small_handoff.h"

using namespace platform::block_design;

namespace {

ImportedDesign imported(const kit::HwhText& text) {
  return import_design(platform::handoff::read_hwh(text.text(), "small.hwh"));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(fit_of_imported_parts)

BOOST_AUTO_TEST_CASE(an_engine_with_two_clocks_is_a_stub_with_the_reason) {
  const auto engine = [](const std::string& stream_clock) {
    kit::HwhText text = kit::small_handoff();
    text.module("vdma_0", "xilinx.com:ip:axi_vdma:6.3", "",
                kit::pin("I", "m_axi_mm2s_aclk", "ps_FCLK_CLK0") +
                    kit::pin("I", "m_axis_mm2s_aclk", stream_clock));
    const ImportedDesign design = imported(text);
    const auto part = std::find_if(design.parts.begin(), design.parts.end(),
                                   [](const auto& one) { return one.name == "vdma_0"; });
    BOOST_TEST_REQUIRE((part != design.parts.end()));
    return part->why;
  };
  BOOST_TEST(engine("clk_0_pixel_clk") ==
             "its pins m_axi_mm2s_aclk and m_axis_mm2s_aclk have different clocks, and its model "
             "has one");
  BOOST_TEST(engine("ps_FCLK_CLK0") == "");
}

// The wizard's stream is often switched on and left open.
BOOST_AUTO_TEST_CASE(a_stream_of_the_converter_matters_where_it_is_joined) {
  for (const std::string joined : {"__NOC__", "samples"}) {
    kit::HwhText text = kit::small_handoff();
    text.module("xadc_0", "xilinx.com:ip:xadc_wiz:3.3",
                kit::parameter("INTERFACE_SELECTION", "Enable_AXI") +
                    kit::parameter("C_HAS_AXI4STREAM", "1"),
                "", kit::bus("MASTER", "M_AXIS", joined, "axis"));
    const ImportedDesign design = imported(text);
    const auto part = std::find_if(design.parts.begin(), design.parts.end(),
                                   [](const auto& one) { return one.name == "xadc_0"; });
    BOOST_TEST_REQUIRE((part != design.parts.end()));
    BOOST_TEST(part->why == (joined == "samples" ? "its stream M_AXIS is not modelled" : ""));
    BOOST_CHECK_NO_THROW(parse_design(design.text, "design.yaml"));
  }
}

BOOST_AUTO_TEST_SUITE_END()

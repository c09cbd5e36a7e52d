// Unknown keys, wrong units, values out of range, files that are none.
#include <boost/test/unit_test.hpp>

#include "command_line.h"

using namespace negative;

namespace {

struct Configuration : CommandLine {
  /// The message for a configuration file of this text.
  void file_refused(const std::string& text, const Words& parts) const {
    kit::write_file(*this / "platform.yaml", text);
    Words all{"platform.yaml"};
    all.insert(all.end(), parts.begin(), parts.end());
    run_refuses({"--config", "platform.yaml"}, all);
    refuses({"config", "--config", "platform.yaml"}, all);
  }
  void set_refused(const std::string& assignment, const Words& parts) const {
    run_refuses({"--set", assignment}, parts);
    refuses({"config", "--set", assignment}, parts);
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(configuration, Configuration)

BOOST_AUTO_TEST_CASE(unknown_keys) {
  set_refused("pl.widht=640 px", {"pl.widht", "did you mean", "pl.width"});
  set_refused("ps.fclk_clk1.frequenzy=50 MHz",
              {"ps.fclk_clk1.frequenzy", "ps.fclk_clk1.frequency"});
  set_refused("sw.margn=4 px", {"sw.margn", "sw.margin"});
  set_refused("pl=1", {"pl"});
  set_refused("=1", {"''", "not a key"});
  set_refused("pl.width", {"pl.width"});
  set_refused("", {"--set"});
  file_refused("pl:\n  colour: red\n", {"pl.colour", ":2"});
}

BOOST_AUTO_TEST_CASE(wrong_units) {
  set_refused("device=xc7z02-1", {"device: unknown device 'xc7z02-1'", "'xc7z020-1'"});
  set_refused("clocks=nearly", {"clocks", "nearly", "made", "exact"});
  set_refused("ps.slcr.ps_clk=5 MHz",
              {"ps.slcr.ps_clk: a crystal of 5.000 MHz", "xc7z020-1 takes 30 to 60 MHz"});
  set_refused("ps.fclk_clk1.frequency=50 ms", {"ps.fclk_clk1.frequency", "50 ms", "MHz"});
  set_refused("ps.fclk_clk1.frequency=50", {"ps.fclk_clk1.frequency", "no unit", "MHz"});
  set_refused("pl.width=640 mm", {"pl.width", "640 mm", "px"});
  set_refused("ps.cpu.timeout=5 MHz", {"ps.cpu.timeout", "5 MHz"});
  set_refused("pl.blob_detection.label_count=128 px", {"pl.blob_detection.label_count", "128 px"});
  file_refused("ps:\n  cpu:\n    stack_size: 8 furlongs\n",
               {"ps.cpu.stack_size", "8 furlongs", ":3"});
}

BOOST_AUTO_TEST_CASE(rates_that_no_camera_has) {
  for (const char* rate : {"0", "-1", "0 fps", "1e-3"})
    run_refuses({std::string("--rate=") + rate},
                {"camera.rate", "--rate", "the nearest is 0.1 fps"});
  for (const char* rate : {"1e9", "1e9 fps"})
    run_refuses({"--rate", rate}, {"camera.rate", "the nearest is 100000 fps"});
  for (const char* rate : {"nan", "fast", "60 furlongs", ""})
    run_refuses({"--rate", rate}, {"camera.rate", "write 60 fps, or none"});
  run_refuses({"--rate"}, {"--rate"});
  set_refused("camera.rate=60", {"camera.rate", "write 60 fps, or none"});
  run_refuses({"--rate", "60", "fps", "--set", "sw.upload=1"},
              {"sw.upload is 1", "camera.rate is 60 fps", "leave one of them out"});
}

BOOST_AUTO_TEST_CASE(bursts_that_no_dma_makes) {
  set_refused("pl.burst_words=48", {"pl.burst_words is 48", "the nearest is 32"});
  set_refused("pl.burst_words=1", {"pl.burst_words", "2 to 256"});
  set_refused("pl.burst_words=512", {"pl.burst_words", "2 to 256"});
  set_refused("pl.burst_words=256", {"multiple of 8192", "pl.burst_words=128 fits"});
  set_refused("sw.burst_words=16", {"unknown key 'sw.burst_words'"});
  run_refuses({"--set", "pl.burst_words=128", "--set", "pl.axi_dma_1.length_width=8"},
              {"pl.axi_dma_1.length_width is 8", "512 bytes and needs 10"});
}

BOOST_AUTO_TEST_CASE(values_out_of_range) {
  set_refused("ps.fclk_clk1.frequency=0 MHz", {"ps.fclk_clk1.frequency", "1 kHz", "1000 GHz"});
  set_refused("ps.fclk_clk1.frequency=-5 MHz", {"ps.fclk_clk1.frequency"});
  set_refused("ps.fclk_clk1.frequency=2e99 MHz", {"ps.fclk_clk1.frequency"});
  set_refused("ps.cpu.stack_size=1 KiB", {"ps.cpu.stack_size", "64 KiB"});
  set_refused("pl.blob_detection.label_count=3", {"pl.blob_detection.label_count", "4", "1024"});
  set_refused("sw.margin=65 px", {"sw.margin", "64 px"});
  set_refused("fidelity=rough", {"fidelity", "rough", "clocked"});
  set_refused("pl.axi_gpio_0.is_dual=maybe", {"pl.axi_gpio_0.is_dual", "maybe", "true"});
  set_refused("pl.corner_detection.threshold=30.5", {"pl.corner_detection.threshold", "30.5"});
  set_refused("pl.corner_detection.threshold=", {"pl.corner_detection.threshold"});
  set_refused("pl.width=650 px", {"pl.width", "multiple of 32"});
  set_refused("pl.height=481 px", {"pl.height", "multiple of 1024"});
  set_refused("pl.width=2080 px", {"pl.width", "2048"});
}

/// Values that are allowed one by one and do not fit together.
BOOST_AUTO_TEST_CASE(values_that_do_not_fit_together) {
  set_refused("pl.bram.depth_a=16", {"pl.bram.depth_a", "76800 words"});
  set_refused("ps.ddr.size=1 MiB", {"ps.ddr.dma_base", "ps.ddr.size"});
  set_refused("ps.ddr.dma_base=0x3ffff000", {"ps.ddr.dma_base"});
}

BOOST_AUTO_TEST_CASE(configuration_files) {
  run_refuses({"--config", "missing.yaml"}, {"missing.yaml"});
  run_refuses({"--config", "."}, {"is a folder"});
  file_refused("pl: [1, 2\n", {});
  file_refused("pl:\n  width: 640 px\n bad: 1\n", {":3"});
  file_refused("just words\n", {});
  file_refused("- pl\n- ps\n", {});
  file_refused("pl:\n  width: [640 px]\n", {"pl.width"});
  file_refused("pl:\n  width: 640 px\n  width: 320 px\n", {"pl.width"});
  file_refused(std::string("\x00\x01\x02\xff", 4), {});
}

BOOST_AUTO_TEST_CASE(what_is_right_is_accepted) {
  kit::write_file(*this / "platform.yaml", start({"config"}).out);
  const kit::Outcome outcome =
      start({"config", "--config", "platform.yaml", "--set", "pl.width=320 px"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "width: 320 px"));
  kit::write_file(*this / "empty.yaml", "");
  BOOST_TEST(start({"config", "--config", "empty.yaml"}).exit_code == 0);
}

BOOST_AUTO_TEST_SUITE_END()

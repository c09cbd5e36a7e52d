#include "pipeline.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace harness {

namespace control_packet = pl::control_packet;

Settings::Settings(const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) configuration.set(assignment);
}

pl::Fidelity fidelity_under_test() {
  const char* name = std::getenv("MARKERVP_TEST_FIDELITY");
  if (!name || std::string(name) == "clocked") return pl::Fidelity::clocked;
  if (std::string(name) == "tlm") return pl::Fidelity::tlm;
  throw std::runtime_error(std::string("MARKERVP_TEST_FIDELITY=") + name + ": clocked or tlm");
}

Pipeline::Pipeline(Clocks clocks, const std::vector<std::string>& settings)
    : settings_(settings),
      fclk_clk0("fclk_clk0", scheduler, clocks.system_hz),
      fclk_clk1("fclk_clk1", scheduler, clocks.pixel_hz) {
  pl.gpio_in()(driver.gpio_io_o);
  pl.por()(driver.peripheral_reset);
  pl.image_stream()(image_link);
  source.m(image_link);
  pl.binary_stream()(binary_link);
  sink.s(binary_link);
  sink.accept(true);
  // A platform in which everything sleeps until the test wakes it is no mistake here.
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_NO_SC_START_ACTIVITY_,
                                          sc_core::SC_DO_NOTHING);
  const std::uint64_t slower = std::max(fclk_clk0.duration_ps(1), fclk_clk1.duration_ps(1));
  driver.hold_ps = std::max(driver.hold_ps, 4 * slower);
  settings_.configuration.check_unused();
}

void Pipeline::load(const Image& image) {
  std::copy(image.begin(), image.end(), pl.bram.contents().begin());
}

std::vector<Word> Pipeline::run_frame() {
  scheduler.set_batch(true);
  driver.start_frame();
  sc_core::sc_start();
  scheduler.set_batch(false);
  return words();
}

void Pipeline::run_to(std::uint64_t ps) {
  sc_core::sc_start(vp::from_ps(ps + 1) - sc_core::sc_time_stamp());
}

void Pipeline::reset(std::uint32_t held) {
  driver.control(held | control_packet::rst);
  run_for(driver.hold_ps);
  driver.control(held);
  run_for(driver.hold_ps);
}

void Pipeline::raise_ena() {
  monitor.start();
  driver.control(driver.control() | control_packet::ena);
}

std::vector<Word> Pipeline::words() const {
  std::vector<Word> sorted = monitor.words;
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::vector<std::string> frame_size(int width, int height) {
  return {"pl.width=" + std::to_string(width) + " px",
          "pl.height=" + std::to_string(height) + " px"};
}

}  // namespace harness

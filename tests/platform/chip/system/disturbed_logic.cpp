#include "disturbed_logic.h"

#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <pl/control_block/control_block.h>

namespace kit {

namespace {

namespace control_packet = pl::control_packet;

constexpr std::uint32_t memory_base = 0x1000'0000;
constexpr std::uint32_t dma_0 = 0x4040'0000, dma_1 = 0x4041'0000, gpio_0 = 0x4120'0000,
                        gpio_1 = 0x4121'0000;

}  // namespace

/// Notes each change of a signal.
class DisturbedLogic::Watch : public vp::SignalListener {
 public:
  Watch(DisturbedLogic& logic, vp::SignalBase& signal) : logic_(logic) { signal.attach(*this); }

 private:
  void on_change(vp::SignalBase& signal, std::uint32_t) override {
    logic_.note(std::string(signal.name()) + " = " + std::to_string(signal.bits()));
  }
  DisturbedLogic& logic_;
};

DisturbedLogic::Configured::Configured(Size size, const std::vector<std::string>& settings) {
  configuration.set("pl.width=" + std::to_string(size.width) + " px");
  configuration.set("pl.height=" + std::to_string(size.height) + " px");
  for (const std::string& setting : settings) configuration.set(setting);
}

DisturbedLogic::~DisturbedLogic() = default;

DisturbedLogic::DisturbedLogic(pl::Fidelity fidelity, Size size,
                               const std::vector<std::string>& settings)
    : configured_(size, settings), pl_("pl", system_clk_, pixel_clk_, fidelity) {
  reports_.redirect(ignored_);
  configured_.configuration.check_unused();
  software_.socket.bind(pl_.axi_interconnect.socket);
  pl_.axi_mem_interconnect.map("memory", memory_base, 0x40000).bind(memory_.socket);
  pl_.proc_sys_reset.ext_reset_in(reset_n_);
  for (vp::SignalBase* signal : std::initializer_list<vp::SignalBase*>{
           &pl_.sensor_input.frame_ena, &pl_.corner_detection.corner_out, &pl_.blob_detection.idle,
           &pl_.blob_detection.blob_out, &pl_.global_threshold.active_threshold,
           &pl_.frame_status.busy, &pl_.frame_status.done, &pl_.feature_packaging.feature,
           &pl_.concat.dout}) {
    watches_.push_back(std::make_unique<Watch>(*this, *signal));
  }
}

std::uint32_t DisturbedLogic::below(std::uint32_t limit) {
  random_ = random_ * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
  return static_cast<std::uint32_t>((random_ >> 33) % limit);
}

void DisturbedLogic::note(const std::string& event) {
  seen_.push_back(std::to_string(scheduler_.now_ps()) + ": " + event);
}

void DisturbedLogic::pause(std::uint32_t longest_ns) {
  sc_core::wait(vp::from_ps(std::uint64_t{below(longest_ns)} * 1000 + below(1000)));
  scheduler_.synchronise();
}

std::vector<std::string> DisturbedLogic::run(std::uint64_t seed, unsigned actions) {
  random_ = seed;
  // Dark and bright spots of many sizes: corners, blobs and both thresholds' sides.
  for (std::uint32_t i = 0; i < 0x40000; ++i) memory_.data()[i] = below(2) ? 40 + below(60) : 200;
  for (auto& pixel : pl_.bram.contents()) {
    pixel = static_cast<std::uint8_t>(below(8) == 0 ? below(256) : (below(2) ? 30 : 220));
  }
  software_.simulate([&] {
    for (unsigned i = 0; i < actions; ++i) {
      act();
      pause(below(4) == 0 ? 60'000 : 3'000);
    }
    sc_core::wait(vp::from_ps(2'000'000'000));
    look();
  });
  return seen_;
}

void DisturbedLogic::act() {
  switch (below(16)) {
    case 0:
    case 1:
    case 2:
      return control(packet_ | control_packet::ena);
    case 3:
      return control(packet_ & ~control_packet::ena);
    case 4:
      return below(4) == 0 ? reset_logic() : look();
    case 5:
      return load_threshold();
    case 6:
    case 7:
      return upload();
    case 8:
    case 9:
    case 10:
      return receive();
    case 11:
      return below(6) == 0 ? restart_dma() : receive();
    case 12:
      return below(3) == 0 ? change_clock() : toggle_ready();
    case 13:
      return look();
    default:
      return toggle_ready();
  }
}

void DisturbedLogic::control(std::uint32_t packet) {
  packet_ = packet;
  software_.write(gpio_0 + axi_gpio::GPIO_DATA, packet);
}

void DisturbedLogic::reset_logic() {
  control((packet_ & ~control_packet::ena) | control_packet::rst);
  // Of the slowest clocks no edge may see it.
  sc_core::wait(vp::from_ps(1000 * below(below(2) ? 100 : 4'000)));
  control(packet_ & ~control_packet::rst);
}

void DisturbedLogic::load_threshold() {
  const std::uint32_t level = 20 + below(220);
  control((packet_ & ~(0xFFu << control_packet::threshold_shift)) | control_packet::wr_thresh |
          level << control_packet::threshold_shift);
  if (below(3) == 0) return;  // stays, and wins over the frame's own
  pause(500);
  control(packet_ & ~control_packet::wr_thresh);
}

void DisturbedLogic::toggle_ready() {
  for (unsigned i = below(6); i > 0; --i) {
    control(packet_ ^ 1u << control_packet::ready_shift);
    pause(120);
  }
}

void DisturbedLogic::upload() {
  control(below(8) == 0 ? packet_ & ~control_packet::wr_en : packet_ | control_packet::wr_en);
  const std::uint32_t words = below(3) == 0 ? 1 + below(90) : 32;
  software_.write(dma_0 + axi_dma::MM2S_DMACR, axi_dma::dmacr::RS | axi_dma::dmacr::IOC_IrqEn);
  software_.write(dma_0 + axi_dma::MM2S_DMASR, axi_dma::dmasr::interrupts);
  software_.write(dma_0 + axi_dma::MM2S_SA, memory_base + 4 * below(1000));
  software_.write(dma_0 + axi_dma::MM2S_LENGTH, 4 * words);
  if (below(4) == 0) {
    pause(800);
    control(packet_ ^ control_packet::wr_en);
  }
}

void DisturbedLogic::receive() {
  const std::uint32_t words = below(4) == 0 ? 1 + below(80) : 32;
  software_.write(dma_1 + axi_dma::S2MM_DMACR, axi_dma::dmacr::RS | axi_dma::dmacr::IOC_IrqEn);
  software_.write(dma_1 + axi_dma::S2MM_DMASR, axi_dma::dmasr::interrupts);
  software_.write(dma_1 + axi_dma::S2MM_DA, memory_base + 0x20000 + 128 * below(500));
  software_.write(dma_1 + axi_dma::S2MM_LENGTH, 4 * words);
}

void DisturbedLogic::restart_dma() {
  software_.write((below(2) ? dma_0 : dma_1 + 0x30) + axi_dma::MM2S_DMACR, axi_dma::dmacr::Reset);
}

void DisturbedLogic::change_clock() {
  static constexpr std::uint64_t frequencies[] = {1'000'000,  3'333'333,  25'000'000,  33'333'333,
                                                  50'000'000, 74'250'000, 100'000'000, 142'857'143};
  vp::Clock& clock = below(2) ? system_clk_ : pixel_clk_;
  if (below(4) == 0) {
    clock.set_frequency(0);
    pause(2'000);
  }
  clock.set_frequency(frequencies[below(8)]);
}

void DisturbedLogic::look() {
  scheduler_.synchronise();
  pl_.settle();
  for (const std::uint32_t address : {dma_0 + axi_dma::MM2S_DMASR, dma_1 + axi_dma::S2MM_DMASR,
                                      dma_1 + axi_dma::S2MM_LENGTH, gpio_1 + axi_gpio::GPIO_DATA}) {
    note("read " + std::to_string(address) + " = " + std::to_string(software_.read(address)));
  }
  std::uint32_t hash = 2'166'136'261u;
  const auto add = [&hash](unsigned char byte) { hash = (hash ^ byte) * 16'777'619u; };
  for (const unsigned char byte : pl_.bram.contents()) add(byte);
  for (std::uint32_t i = 0; i < 0x40000; ++i) add(memory_.data()[i]);
  note("memories " + std::to_string(hash));
  note("overflows " + std::to_string(pl_.feature_packaging.feature_overflow) + " " +
       std::to_string(pl_.axi_threshold_bridge.bridge_overflow) + " " +
       std::to_string(pl_.clock_crossing.crossing_overflow) + " " +
       std::to_string(pl_.blob_detection.label_overflow));
  note("pixels read " + std::to_string(pl_.bram.reads_b));
  for (const vp::AxiStream* link : {&pl_.image_stream_link, &pl_.binary_stream_link}) {
    note(std::string(link->name()) + " " + std::to_string(link->beats) + " beats " +
         std::to_string(link->packets) + " packets");
  }
}

}  // namespace kit

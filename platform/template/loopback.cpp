// Another platform from the same models: a block memory, a DMA whose output stream is its input
// stream, and a GPIO, behind one AXI interconnect. A test bench plays the processor.
//
//   bench ── axi ─┬─ 0x4040'0000  axi_dma (registers)      m_axis_mm2s ──> s_axis_s2mm
//                 ├─ 0x4120'0000  axi_gpio                  (one link: what it reads it writes)
//                 └─ 0xC000'0000  axi_bram_ctrl  <── both memory ports of axi_dma
#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <vp/unit.h>
#include <xilinx/axi_bram_ctrl/axi_bram_ctrl.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>

#include <cstdint>
#include <exception>
#include <iostream>
#include <systemc>

namespace {

constexpr std::uint32_t dma_base = 0x4040'0000;
constexpr std::uint32_t gpio_base = 0x4120'0000;
constexpr std::uint32_t memory_base = 0xC000'0000;
constexpr std::uint32_t window = 0x1'0000;
constexpr std::uint32_t memory_size = 0x2000;

/// The hardware: one line for each component, then one for each wire.
struct Platform : sc_core::sc_module {
  explicit Platform(sc_core::sc_module_name name) : sc_module(name) {
    axi.map("axi_dma", dma_base, window).bind(dma.s_axi_lite.socket);
    axi.map("axi_gpio", gpio_base, window).bind(gpio.s_axi.socket);
    axi.map("memory", memory_base, memory_size).bind(memory.s_axi);
    dma.mm2s().m_axi.link.socket.bind(axi.socket);
    dma.s2mm().m_axi.link.socket.bind(axi.socket);
    dma.mm2s().m_axis(loop);
    dma.s2mm().s_axis(loop);
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock aclk{"aclk", scheduler, 100'000'000};
  xilinx::AxiInterconnect axi{"axi", aclk};
  xilinx::AxiBramCtrl memory{"memory", aclk, {memory_size, false, false}};
  xilinx::AxiDma dma{"axi_dma", aclk};
  xilinx::AxiGpio gpio{"axi_gpio", aclk};
  vp::AxiStream loop{"loop"};
};

/// The test bench: a bus master with a script.
class Bench : public sc_core::sc_module {
 public:
  Bench(sc_core::sc_module_name name, Platform& platform) : sc_module(name), platform_(platform) {
    SC_HAS_PROCESS(Bench);
    SC_THREAD(run);
    socket.bind(platform.axi.socket);
  }

  tlm_utils::simple_initiator_socket<Bench> socket{"socket"};

  /// The script ran to its end, and everything was as it should be.
  bool passed() const { return ended_ && failures_ == 0; }

 private:
  static constexpr std::uint32_t bytes = 1024;
  const sc_core::sc_time poll_period{100, sc_core::SC_NS};
  static constexpr std::uint32_t from = memory_base, to = memory_base + memory_size / 2;

  void run() {
    write(gpio_base + axi_gpio::GPIO_TRI, 0);
    write(gpio_base + axi_gpio::GPIO_DATA, 0x5A);
    check(platform_.gpio.gpio.io_o == 0x5A, "the GPIO's pins show what was written");
    for (std::uint32_t i = 0; i < bytes; i += 4) write(from + i, pattern(i));
    copy_by_dma();
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < bytes; i += 4) wrong += read(to + i) != pattern(i) ? 1 : 0;
    check(wrong == 0, "the DMA copied every word");
    check(read(gpio_base + 2 * window, tlm::TLM_ADDRESS_ERROR_RESPONSE) == 0,
          "an address where nothing is answers with an error");
    ended_ = true;
    sc_core::sc_stop();
  }

  void copy_by_dma() {
    write(dma_base + axi_dma::S2MM_DMACR, axi_dma::dmacr::RS);
    write(dma_base + axi_dma::S2MM_DA, to);
    write(dma_base + axi_dma::S2MM_LENGTH, bytes);
    write(dma_base + axi_dma::MM2S_DMACR, axi_dma::dmacr::RS);
    write(dma_base + axi_dma::MM2S_SA, from);
    write(dma_base + axi_dma::MM2S_LENGTH, bytes);
    const std::uint64_t start = platform_.scheduler.now_ps();
    check(wait_for_idle(axi_dma::MM2S_DMASR), "the DMA has sent the packet");
    check(wait_for_idle(axi_dma::S2MM_DMASR), "the DMA has received the packet");
    const std::uint64_t took = platform_.scheduler.now_ps() - start;
    std::cout << "copied " << bytes << " bytes in " << vp::format_time(took) << std::endl;
    check(read(dma_base + axi_dma::S2MM_LENGTH) == bytes, "S2MM_LENGTH has the bytes received");
  }

  /// False if the channel is still busy after far more time than a transfer needs.
  bool wait_for_idle(std::uint32_t status) {
    for (unsigned polls = 0; polls < 1000; ++polls, wait(poll_period)) {
      if ((read(dma_base + status) & axi_dma::dmasr::Idle) != 0) return true;
    }
    return false;
  }

  static std::uint32_t pattern(std::uint32_t i) { return 0x01020304u * (i + 1); }

  std::uint32_t read(std::uint32_t address,
                     tlm::tlm_response_status expected = tlm::TLM_OK_RESPONSE) {
    std::uint32_t word = 0;
    access(tlm::TLM_READ_COMMAND, address, word, expected);
    return word;
  }
  void write(std::uint32_t address, std::uint32_t word) {
    access(tlm::TLM_WRITE_COMMAND, address, word, tlm::TLM_OK_RESPONSE);
  }

  void access(tlm::tlm_command command, std::uint32_t address, std::uint32_t& word,
              tlm::tlm_response_status expected) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
    payload.set_data_length(sizeof word);
    payload.set_streaming_width(sizeof word);
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    socket->b_transport(payload, delay);
    wait(delay);
    check(payload.get_response_status() == expected, payload.get_response_string().c_str());
  }

  void check(bool good, const char* what) {
    if (good) return;
    std::cerr << "failed: " << what << std::endl;
    ++failures_;
  }

  Platform& platform_;
  unsigned failures_ = 0;
  bool ended_ = false;
};

}  // namespace

int sc_main(int, char**) {
  const vp::ReportRouter reports;
  try {
    Platform platform("platform");
    Bench bench("bench", platform);
    sc_core::sc_start();
    std::cout << (bench.passed() ? "passed" : "failed") << std::endl;
    return bench.passed() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 3;
  }
}

// A PS program that waits for an interrupt or a DMA that never comes, for the reason that its
// option names: one bit of one register each.
#include <axi_dma_registers.h>
#include <drivers/platform_addresses.h>
#include <gic_registers.h>
#include <hal/hal.h>
#include <private_timer_registers.h>

namespace {

enum class Mistake {
  none,
  not_enabled,
  spi_number,
  priority_masked,
  cpu_masked,
  not_enabled_at_device,
  not_ended,
  distributor_off,
  dma_not_started,
  dma_without_length,
  dma_without_data,
  dma_not_taken,
  dma_polled,
  dma_keeps_interrupt,
};
const hal_option_info options[] = {{"mistake", "", 0, 0, 13, "what keeps the program waiting"}};

Mistake mistake;
volatile bool came;

std::uint32_t distributor(std::uint32_t offset) {
  return gic::distributor_base + offset;
}

void on_interrupt(void*) {
  const std::uint32_t id = hal_read32(gic::cpu_interface_base + gic::ICCIAR);
  hal_write32(private_timer::base + private_timer::INTERRUPT_STATUS, 1);
  if (mistake != Mistake::not_ended || came) {
    came = true;
    hal_write32(gic::cpu_interface_base + gic::ICCEOIR, id);
    return;
  }
  came = true;
}

void set_up_controller() {
  constexpr std::uint32_t id = gic::private_timer_id;
  hal_interrupt_connect(&on_interrupt, nullptr);
  const std::uint32_t priority = mistake == Mistake::priority_masked ? 0xF8 : 0xA0;
  hal_write32(distributor(gic::ICDIPR(id / 4)), priority << id % 4 * 8);
  if (mistake != Mistake::not_enabled) hal_write32(distributor(gic::ICDISER(0)), 1u << id);
  hal_write32(gic::cpu_interface_base + gic::ICCPMR, 0xF0);
  hal_write32(gic::cpu_interface_base + gic::ICCICR, 1);
  hal_write32(distributor(gic::ICDDCR), mistake == Mistake::distributor_off ? 0 : 1);
  if (mistake != Mistake::cpu_masked) hal_interrupt_enable(true);
}

void start_timer() {
  namespace control = private_timer::control;
  hal_write32(private_timer::base + private_timer::LOAD, 33'333);
  hal_write32(private_timer::base + private_timer::CONTROL,
              control::Enable | control::Auto_Reload |
                  (mistake == Mistake::not_enabled_at_device ? 0 : control::IRQ_Enable));
}

std::uint32_t dma(std::uint32_t offset) {
  return drivers::addresses::dma_binary() + offset;
}

/// Sends words to the logic, which takes none before its start bit is set.
void send() {
  const std::uint32_t to_logic = drivers::addresses::dma_image();
  const hal_dma_buffer buffer = hal_dma_allocate(64, 32);
  hal_cache_flush(buffer.data, buffer.size);
  hal_write32(to_logic + axi_dma::MM2S_DMACR, axi_dma::dmacr::RS);
  hal_write32(to_logic + axi_dma::MM2S_SA, buffer.bus_address);
  hal_write32(to_logic + axi_dma::MM2S_LENGTH, 64);
  while ((hal_read32(to_logic + axi_dma::MM2S_DMASR) & axi_dma::dmasr::IOC_Irq) == 0) continue;
}

void receive() {
  const hal_dma_buffer buffer = hal_dma_allocate(256, 32);
  if (mistake != Mistake::dma_not_started) hal_write32(dma(axi_dma::S2MM_DMACR), 1);
  hal_write32(dma(axi_dma::S2MM_DA), buffer.bus_address);
  if (mistake == Mistake::dma_without_data) hal_write32(dma(axi_dma::S2MM_LENGTH), 256);
  while ((hal_read32(dma(axi_dma::S2MM_DMASR)) & axi_dma::dmasr::IOC_Irq) == 0) continue;
}

/// A transfer from an address without memory.
void read_nowhere(std::uint32_t enabled) {
  const std::uint32_t to_logic = drivers::addresses::dma_image();
  hal_write32(to_logic + axi_dma::MM2S_DMACR, axi_dma::dmacr::RS | enabled);
  hal_write32(to_logic + axi_dma::MM2S_SA, 0x8000'0000);
  hal_write32(to_logic + axi_dma::MM2S_LENGTH, 64);
}

/// Waits for interrupt 61, which the device raises, but the number is enabled that it has among
/// those of the PL; or the number is right, and the device keeps it.
void wait_for_error() {
  hal_interrupt_connect(&on_interrupt, nullptr);
  hal_write32(distributor(gic::ICDISER(mistake == Mistake::spi_number ? 0 : 1)), 1u << 29);
  hal_write32(gic::cpu_interface_base + gic::ICCPMR, 0xF0);
  hal_write32(gic::cpu_interface_base + gic::ICCICR, 1);
  hal_write32(distributor(gic::ICDDCR), 1);
  hal_interrupt_enable(true);
  read_nowhere(mistake == Mistake::spi_number ? axi_dma::dmacr::Err_IrqEn : 0);
  while (!came) hal_wait_for_interrupt();
}

/// Uses no interrupts, and looks for an end of its transfer that does not come.
void poll() {
  read_nowhere(0);
  const std::uint32_t to_logic = drivers::addresses::dma_image();
  while ((hal_read32(to_logic + axi_dma::MM2S_DMASR) & axi_dma::dmasr::Idle) == 0) continue;
}

int run() {
  mistake = static_cast<Mistake>(static_cast<int>(hal_option(0)));
  if (mistake == Mistake::dma_polled) {
    poll();
  } else if (mistake == Mistake::dma_keeps_interrupt) {
    wait_for_error();
  } else if (mistake == Mistake::dma_not_taken) {
    send();
  } else if (mistake >= Mistake::dma_not_started) {
    receive();
  } else if (mistake == Mistake::spi_number) {
    wait_for_error();
  } else {
    set_up_controller();
    start_timer();
    for (int i = 0; i < 2; ++i) {
      came = came && i == 0;
      if (mistake == Mistake::cpu_masked) {
        while (!came) continue;
      }
      hal_wait_for_interrupt();
    }
  }
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "waiting", run, nullptr, 0, nullptr, 0, options, 1};
}

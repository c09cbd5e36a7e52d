// A PS program that runs frames with the hardware's bare registers, and makes the mistake that its
// option names: those that a platform forgives and a chip does not.
#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <drivers/gic.h>
#include <drivers/platform_addresses.h>
#include <drivers/slcr.h>
#include <drivers/timers.h>
#include <hal/hal.h>
#include <marker/result.h>

namespace {

namespace addresses = drivers::addresses;

constexpr std::uint32_t ena = 1, rst = 2, ready = 4;
constexpr std::uint32_t end_word = 0xFFFF'FFFF;
constexpr std::uint32_t packet_bytes = 128, pattern = 0xA5A5'A5A5;

enum class Mistake {
  none,
  ready_twice,
  ready_too_early,
  polls_after_end,
  reads_after_end,
  spins_on_buffer,
  spins_with_barrier,
  waits_for_handler,
  works_on_old_data,
  works_on_new_data,
  publishes_old_data,
  acknowledges_late,
  ticks_too_fast,
  sleeps_unmasked,
  transfers_too_much,
  clocks_too_fast,
  spins_with_invalidation,
};
const hal_option_info options[] = {
    {"mistake", "", 0, 0, 16, "what the program does wrong"},
    {"upload", "", 0, 0, 1, "0: the test bench puts images into the image store"}};

Mistake mistake;
hal_dma_buffer buffer;
drivers::Gic gic;
volatile bool came;
volatile std::uint32_t sink;
std::uint32_t packet;

std::uint32_t control() {
  return addresses::gpio_control() + axi_gpio::GPIO_DATA;
}
std::uint32_t features() {
  return addresses::gpio_features() + axi_gpio::GPIO_DATA;
}
std::uint32_t dma(std::uint32_t offset) {
  return addresses::dma_binary() + offset;
}

void send(std::uint32_t word) {
  packet = word;
  hal_write32(control(), packet);
}

const volatile std::uint32_t* words() {
  return static_cast<const volatile std::uint32_t*>(buffer.data);
}

constexpr unsigned many = 1'500;
unsigned calls;
drivers::PrivateTimer timer;

void on_packet(void*) {
  if (mistake == Mistake::acknowledges_late && ++calls < many) return;
  hal_write32(dma(axi_dma::S2MM_DMASR), axi_dma::dmasr::IOC_Irq);
  came = true;
}

// The next tick is there before it returns.
void on_tick(void*) {
  timer.acknowledge();
  if (++calls == many) timer.stop();
  for (int i = 0; i < 10; ++i) sink = hal_read32(control());
}

void tick() {
  constexpr std::uint32_t private_timer_interrupt = 29;
  gic.connect(private_timer_interrupt, drivers::Trigger::rising_edge, &on_tick, nullptr);
  timer.initialise({1, true, true});
  timer.start(10);
  while (calls < many) hal_barrier();
}

void clock_faster() {
  drivers::Slcr slcr;
  slcr.initialise({});
  const std::uint32_t before = slcr.pl_clock(1);
  slcr.set_pl_clock(1, 500'000'000);
  slcr.set_pl_clock(1, before);
}

// One packet of the binary image; the rest of it is dropped.
void arm() {
  for (std::uint32_t i = 0; i < packet_bytes / 4; ++i) {
    static_cast<std::uint32_t*>(buffer.data)[i] = pattern;
  }
  hal_cache_flush(buffer.data, buffer.size);
  const bool interrupt = mistake == Mistake::waits_for_handler ||
                         mistake == Mistake::acknowledges_late ||
                         mistake == Mistake::sleeps_unmasked;
  hal_write32(dma(axi_dma::S2MM_DMACR),
              axi_dma::dmacr::RS | (interrupt ? axi_dma::dmacr::IOC_IrqEn : 0));
  hal_write32(dma(axi_dma::S2MM_DA), buffer.bus_address);
  hal_write32(dma(axi_dma::S2MM_LENGTH),
              packet_bytes + (mistake == Mistake::transfers_too_much ? 4 : 0));
}

__attribute__((noinline)) void look_at_all_words() {
  for (int round = 0; round < 20'000; ++round) {
    for (std::uint32_t i = 0; i < packet_bytes / 4; ++i) sink = words()[i];
  }
}

__attribute__((noinline)) void take_packet() {
  switch (mistake) {
    case Mistake::spins_on_buffer:
      while (words()[packet_bytes / 4 - 1] == pattern) continue;
      break;
    case Mistake::spins_with_barrier:
      while (words()[packet_bytes / 4 - 1] == pattern) hal_barrier();
      break;
    case Mistake::spins_with_invalidation:
      while (words()[packet_bytes / 4 - 1] == pattern)
        hal_cache_invalidate(buffer.data, buffer.size);
      break;
    case Mistake::waits_for_handler:
      while (!came) continue;
      break;
    case Mistake::acknowledges_late:
      while (!came) hal_barrier();
      break;
    case Mistake::sleeps_unmasked:
      hal_wait_for_interrupt();
      break;
    default:
      while ((hal_read32(dma(axi_dma::S2MM_DMASR)) & axi_dma::dmasr::Idle) == 0) continue;
  }
  if (mistake == Mistake::works_on_old_data) look_at_all_words();
  if (mistake != Mistake::publishes_old_data) hal_cache_invalidate(buffer.data, buffer.size);
  if (mistake == Mistake::works_on_new_data || mistake == Mistake::publishes_old_data)
    look_at_all_words();
}

void take_words() {
  std::uint32_t last = 0;
  while (last != end_word) {
    last = hal_poll_until_changed(features(), last, 8, 1'000'000).value;
    if (last == end_word) return;
    send(packet ^ ready);
    if (mistake == Mistake::ready_twice) send(packet ^ ready);
  }
}

void process() {
  send(0);
  send(rst);
  send(0);
  arm();
  send(ena);
  if (mistake == Mistake::ready_too_early) send(packet ^ ready);
  take_packet();
  take_words();
  if (mistake == Mistake::polls_after_end) hal_poll_until_changed(features(), end_word, 8, 1'000);
  if (mistake == Mistake::ticks_too_fast) tick();
  if (mistake == Mistake::clocks_too_fast) clock_faster();
  if (mistake == Mistake::reads_after_end) {
    for (int i = 0; i < 3; ++i) hal_read32(features());
  }
}

int run() {
  static marker::FrameResult result;
  mistake = static_cast<Mistake>(static_cast<int>(hal_option(0)));
  buffer = hal_dma_allocate(packet_bytes, 32);
  gic.initialise();
  gic.connect(addresses::dma_binary_interrupt(), drivers::Trigger::level_high, &on_packet, nullptr);
  hal_interrupt_enable(true);
  while (const hal_frame* frame = hal_frame_next()) {
    came = false;
    calls = 0;
    process();
    marker::clear(result);
    result.frame = frame->index;
    hal_publish(marker::frame_result_kind, &result, sizeof result);
  }
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "careless", run, nullptr, 0, nullptr, 0, options, 2};
}

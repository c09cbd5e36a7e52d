// A PS program that sends a buffer by DMA twice, and makes the second time a mistake with its
// caches: what its option `mistake` says, in the cache line that its option `line` says.
#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <drivers/platform_addresses.h>
#include <hal/hal.h>

namespace {

constexpr std::uint32_t write_enable = 1u << 4;  ///< of the image store
constexpr std::uint32_t line = 32, lines = 32, bytes = line * lines, packet = 128;

enum class Mistake {
  none,
  missing,            ///< all is flushed but the line
  early,              ///< all is flushed, then the line is written
  late_start,         ///< the flush begins behind the line
  early_end,          ///< it ends before the line
  other_buffer,       ///< another buffer is flushed
  invalidates,        ///< invalidated in place of flushed
  between_transfers,  ///< the line is written when a part has been sent
  never,              ///< the line is left out the first time
  // No mistakes:
  after_transfer,  ///< the line is written when all has been sent
  same_value,      ///< the line is written as it was
  two_flushes,     ///< in two parts, that meet in the line
};
const hal_option_info options[] = {{"mistake", "", 0, 0, 11, "what the program does wrong"},
                                   {"line", "", 0, 0, lines - 1, "in which line of the buffer"}};

Mistake mistake;
std::uint32_t at;  ///< of the line in the buffer
unsigned char *buffer, *other;
std::uint32_t bus_address;

void write_line(unsigned char value) {
  buffer[at + line - 1] = value;
}

void send(std::uint32_t from, std::uint32_t to) {
  const std::uint32_t dma = drivers::addresses::dma_image();
  hal_write32(dma + axi_dma::MM2S_DMACR, axi_dma::dmacr::RS);
  for (std::uint32_t i = from; i < to; i += packet) {
    hal_write32(dma + axi_dma::MM2S_SA, bus_address + i);
    hal_write32(dma + axi_dma::MM2S_LENGTH, packet);
    while ((hal_read32(dma + axi_dma::MM2S_DMASR) & axi_dma::dmasr::Idle) == 0) continue;
  }
}

void flush_all_but_the_line() {
  if (at != 0) hal_cache_flush(buffer, at);
  if (at + line != bytes) hal_cache_flush(buffer + at + line, bytes - at - line);
}

void maintain() {
  switch (mistake) {
    case Mistake::missing:
      return flush_all_but_the_line();
    case Mistake::late_start:
      if (at + line != bytes) hal_cache_flush(buffer + at + line, bytes - at - line);
      return;
    case Mistake::early_end:
      if (at != 0) hal_cache_flush(buffer, at);
      return;
    case Mistake::other_buffer:
      return hal_cache_flush(other, bytes);
    case Mistake::invalidates:
      return hal_cache_invalidate(buffer, bytes);
    case Mistake::two_flushes:
      hal_cache_flush(buffer, at + 1);
      return hal_cache_flush(buffer + at + line - 1, bytes - at - line + 1);
    default:
      hal_cache_flush(buffer, bytes);
  }
}

int run() {
  mistake = static_cast<Mistake>(static_cast<int>(hal_option(0)));
  at = static_cast<std::uint32_t>(hal_option(1)) * line;
  const hal_dma_buffer first = hal_dma_allocate(bytes, line);
  buffer = static_cast<unsigned char*>(first.data);
  other = static_cast<unsigned char*>(hal_dma_allocate(bytes, line).data);
  bus_address = first.bus_address;
  hal_write32(drivers::addresses::gpio_control() + axi_gpio::GPIO_DATA, write_enable);
  for (std::uint32_t i = 0; i < bytes; ++i) buffer[i] = static_cast<unsigned char>(i);
  if (mistake == Mistake::never) {
    flush_all_but_the_line();
  } else {
    hal_cache_flush(buffer, bytes);
  }
  send(0, bytes);

  const auto before = buffer[at + line - 1];
  const auto changed = static_cast<unsigned char>(before + 1);
  const bool late = mistake == Mistake::early || mistake == Mistake::between_transfers ||
                    mistake == Mistake::after_transfer;
  if (!late && mistake != Mistake::never && mistake != Mistake::same_value) write_line(changed);
  maintain();
  if (mistake == Mistake::early) write_line(changed);
  if (mistake == Mistake::same_value) write_line(before);
  const std::uint32_t part = mistake == Mistake::between_transfers ? at / packet * packet : bytes;
  send(0, part);
  if (mistake == Mistake::between_transfers) write_line(changed);
  send(part, bytes);
  if (mistake == Mistake::after_transfer) write_line(changed);
  return 0;
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "caches", run, nullptr, 0, nullptr, 0, options, 2};
}

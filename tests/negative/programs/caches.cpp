// A PS program that sends a buffer by DMA twice, or receives one and reads it, and makes a mistake
// with its caches: what its option `mistake` says, in the cache line that its option `line` says.
#include <axi_dma_registers.h>
#include <axi_gpio_registers.h>
#include <drivers/platform_addresses.h>
#include <hal/hal.h>

namespace {

constexpr std::uint32_t write_enable = 1u << 4;  ///< of the image store
constexpr std::uint32_t line = 32, lines = 32, bytes = line * lines, packet = 128;

// Of what is sent, and from `receive` on of what is received.
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

  receive,             ///< no mistake: all is invalidated, then read
  receive_missing,     ///< all is invalidated but the line
  receive_early,       ///< all is, but the line before the transfer
  receive_late,        ///< the line is read before all is invalidated
  receive_late_start,  ///< the invalidation begins behind the line
  receive_early_end,   ///< it ends before the line
  receive_other,       ///< another buffer is invalidated
  receive_flushes,     ///< flushed in place of invalidated
  receive_again,       ///< all is, and the line's packet received once more
  receive_drops,       ///< the line is written and then invalidated, and read
  receive_dirty,       ///< the line is written before the transfer, and not flushed
  // No mistakes:
  receive_unread,     ///< the line is not invalidated, and never read
  receive_rewritten,  ///< nor is it, and the program writes it before it reads it
  receive_in_parts,   ///< all is in two parts, that meet in the line
  receive_twice,      ///< before the transfer and after it

  ahead_all,   ///< the packet of the line is read before it comes
  ahead_byte,  ///< a byte of the line is
  ahead_end,   ///< the program ends before it comes
  // No mistakes:
  ahead_polls,  ///< a byte of the line is read until it comes
  ahead_again,  ///< the program has received all, and ends with the engine started again

  left_sending,  ///< it ends while the line is being sent
};
constexpr int most = static_cast<int>(Mistake::left_sending);
const hal_option_info options[] = {{"mistake", "", 0, 0, most, "what the program does wrong"},
                                   {"line", "", 0, 0, lines - 1, "in which line of the buffer"}};

Mistake mistake;
std::uint32_t at;  ///< of the line in the buffer
unsigned char *buffer, *other;
std::uint32_t bus_address;
volatile unsigned char sink;

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

int send_twice() {
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

void arm(std::uint32_t from) {
  const std::uint32_t dma = drivers::addresses::dma_binary();
  hal_write32(dma + axi_dma::S2MM_DMACR, axi_dma::dmacr::RS);
  hal_write32(dma + axi_dma::S2MM_DA, bus_address + from);
  hal_write32(dma + axi_dma::S2MM_LENGTH, packet);
}

void wait_for_packet() {
  const std::uint32_t dma = drivers::addresses::dma_binary();
  while ((hal_read32(dma + axi_dma::S2MM_DMASR) & axi_dma::dmasr::Idle) == 0) continue;
}

void let_packets_come(bool come) {
  constexpr std::uint32_t ena = 1, rst = 2;
  const std::uint32_t control = drivers::addresses::gpio_control() + axi_gpio::GPIO_DATA;
  if (come) return hal_write32(control, ena);
  hal_write32(control, 0);
  hal_write32(control, rst);
  hal_write32(control, 0);
}

// The first packets of a binary image; the rest of it is dropped.
void receive(std::uint32_t from, std::uint32_t to) {
  let_packets_come(false);
  arm(from);
  let_packets_come(true);
  wait_for_packet();
  for (std::uint32_t i = from + packet; i < to; i += packet) {
    arm(i);
    wait_for_packet();
  }
}

void invalidate_all_but_the_line() {
  if (at != 0) hal_cache_invalidate(buffer, at);
  if (at + line != bytes) hal_cache_invalidate(buffer + at + line, bytes - at - line);
}

void read(std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t i = from; i < to; ++i) sink = buffer[i];
}

void invalidate() {
  switch (mistake) {
    case Mistake::receive_missing:
    case Mistake::receive_early:
    case Mistake::receive_unread:
    case Mistake::receive_rewritten:
      return invalidate_all_but_the_line();
    case Mistake::receive_late_start:
      if (at + line != bytes) hal_cache_invalidate(buffer + at + line, bytes - at - line);
      return;
    case Mistake::receive_early_end:
      if (at != 0) hal_cache_invalidate(buffer, at);
      return;
    case Mistake::receive_other:
      return hal_cache_invalidate(other, bytes);
    case Mistake::receive_flushes:
      return hal_cache_flush(buffer, bytes);
    case Mistake::receive_in_parts:
      hal_cache_invalidate(buffer, at + 1);
      return hal_cache_invalidate(buffer + at + line - 1, bytes - at - line + 1);
    default:
      hal_cache_invalidate(buffer, bytes);
  }
}

int take() {
  if (mistake == Mistake::receive_early) hal_cache_invalidate(buffer + at, line);
  if (mistake == Mistake::receive_twice) hal_cache_invalidate(buffer, bytes);
  if (mistake == Mistake::receive_dirty) write_line(1);
  receive(0, bytes);
  if (mistake == Mistake::receive_late) read(at, at + 1);
  invalidate();
  if (mistake == Mistake::receive_again)
    receive(at / packet * packet, at / packet * packet + packet);
  if (mistake == Mistake::receive_drops) {
    write_line(1);
    hal_cache_invalidate(buffer + at, line);
  }
  if (mistake == Mistake::receive_rewritten) {
    for (std::uint32_t i = 0; i < line; ++i) buffer[at + i] = static_cast<unsigned char>(i);
  }
  if (mistake != Mistake::receive_unread) read(at, at + line);
  read(0, at);
  read(at + line, bytes);
  return 0;
}

int take_ahead() {
  const std::uint32_t from = at / packet * packet;
  hal_cache_invalidate(buffer, bytes);
  if (mistake == Mistake::ahead_again) receive(0, bytes);
  let_packets_come(false);
  arm(from);
  switch (mistake) {
    case Mistake::ahead_all:
      read(at, from + packet);
      break;
    case Mistake::ahead_byte:
      read(at, at + 1);
      break;
    case Mistake::ahead_polls:
      for (int i = 0; i < 3; ++i) read(at, at + 1);
      break;
    default:
      return 0;
  }
  let_packets_come(true);
  wait_for_packet();
  hal_cache_invalidate(buffer, bytes);
  return 0;
}

int leave_sending() {
  hal_cache_flush(buffer, bytes);
  const std::uint32_t dma = drivers::addresses::dma_image();
  hal_write32(dma + axi_dma::MM2S_DMACR, axi_dma::dmacr::RS);
  hal_write32(dma + axi_dma::MM2S_SA, bus_address + at / packet * packet);
  hal_write32(dma + axi_dma::MM2S_LENGTH, packet);
  return 0;
}

int run() {
  mistake = static_cast<Mistake>(static_cast<int>(hal_option(0)));
  at = static_cast<std::uint32_t>(hal_option(1)) * line;
  const hal_dma_buffer first = hal_dma_allocate(bytes, line);
  buffer = static_cast<unsigned char*>(first.data);
  other = static_cast<unsigned char*>(hal_dma_allocate(bytes, line).data);
  bus_address = first.bus_address;
  if (mistake == Mistake::left_sending) return leave_sending();
  if (mistake < Mistake::receive) return send_twice();
  return mistake < Mistake::ahead_all ? take() : take_ahead();
}

}  // namespace

extern "C" {
const hal_program hal_program_info = {HAL_ABI, "caches", run, nullptr, 0, nullptr, 0, options, 2};
}

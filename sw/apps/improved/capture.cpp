#include <apps/common/wait.h>
#include <apps/improved/capture.h>
#include <drivers/platform_addresses.h>
#include <marker/work.h>

#include <axi_dma_registers.h>
#include <blob_stream.h>
#include <marker_logic.h>

namespace improved {
namespace {

namespace addresses = drivers::addresses;
namespace control = marker_logic::control;

constexpr std::size_t cache_line = 32;

/// A buffer each for the frame under way and the next.
constexpr std::size_t ring_size = 2;

/// All of a buffer leaves the caches once, so that later only what is read needs to: nothing that
/// the program wrote there before may come over what a DMA engine writes.
bool reserve_buffer(hal_dma_buffer& buffer, std::uint32_t bytes) {
  if (buffer.data != nullptr && buffer.size >= bytes) return true;
  buffer = hal_dma_allocate(bytes, cache_line);
  if (buffer.data == nullptr) return false;
  hal_cache_invalidate(buffer.data, buffer.size);
  return true;
}

}  // namespace

bool Buffers::reserve(std::uint32_t picture_bytes) {
  return reserve_buffer(picture, picture_bytes) &&
         reserve_buffer(packet, blob_stream::max_packet_bytes);
}

bool Capture::initialise() {
  recovery_due_ = false;
  hal_interrupt_enable(false);
  gic_.initialise();
  timer_.initialise();
  control_.initialise({addresses::gpio_control(), 0});
  control_.write(0);
  const bool ready = initialise_dma();
  gic_.connect(addresses::dma_binary_interrupt(), drivers::Trigger::level_high, &Capture::on_packet,
               this);
  gic_.connect(gic::global_timer_id, drivers::Trigger::rising_edge, &Capture::on_alarm, this);
  hal_interrupt_enable(true);
  return ready;
}

void Capture::shut_down() {
  hal_interrupt_enable(false);
  hal_interrupt_connect(nullptr, nullptr);
}

bool Capture::initialise_dma() {
  using Channel = drivers::AxiDmaConfig::Channel;
  const bool picture = picture_dma_.initialise(
      {addresses::dma_image(), Channel::stream_to_memory, HAL_XPAR(AXI_DMA_0_SG_LENGTH_WIDTH)});
  return picture && initialise_packet_dma();
}

bool Capture::initialise_packet_dma() {
  const std::uint32_t base = addresses::dma_binary();
  const unsigned length_bits = HAL_XPAR(AXI_DMA_1_SG_LENGTH_WIDTH);
  has_ring_ = HAL_XPAR(AXI_DMA_1_INCLUDE_SG);
  if (!has_ring_) {
    return packet_dma_.initialise(
        {base, drivers::AxiDmaConfig::Channel::stream_to_memory, length_bits});
  }
  if (descriptors_.data == nullptr) {
    constexpr std::size_t bytes = axi_dma::descriptor::alignment;
    descriptors_ = hal_dma_allocate(ring_size * bytes, bytes);
  }
  return packet_ring_.initialise({base, descriptors_, length_bits});
}

std::uint32_t Capture::max_picture_bytes() const {
  return (1u << HAL_XPAR(AXI_DMA_0_SG_LENGTH_WIDTH)) - 1;
}

bool Capture::recover() {
  control_.write(control::rst);
  const bool ready = initialise_dma();
  control_.write(0);
  recovery_due_ = !ready;
  return ready;
}

bool Capture::start(const Buffers& buffers, std::uint32_t picture_bytes) {
  const marker::FunctionScope scope(marker::Function::capture);
  if (recovery_due_ && !recover()) return false;
  recovery_due_ = true;  // until the frame proves otherwise
  picture_bytes_ = picture_bytes;
  packet_status_ = 0;
  control_.write(0);
  if (!picture_dma_.start(buffers.picture.bus_address, picture_bytes) ||
      !start_packet(buffers.packet.bus_address)) {
    return false;
  }
  started_ = timer_.now();
  control_.write(control::ena);
  return true;
}

bool Capture::start_packet(std::uint32_t address) {
  return has_ring_ ? packet_ring_.give(address, blob_stream::max_packet_bytes)
                   : packet_dma_.start(address, blob_stream::max_packet_bytes);
}

DmaStatus Capture::dma_status() const {
  return {picture_dma_.status(), has_ring_ ? packet_ring_.status() : packet_dma_.status()};
}

void Capture::on_packet(void* self) {
  const marker::FunctionScope scope(marker::Function::dma_interrupt);
  marker::work(marker::Work::interrupts, 1);
  Capture& capture = *static_cast<Capture*>(self);
  capture.packet_status_ =
      capture.has_ring_ ? capture.packet_ring_.acknowledge() : capture.packet_dma_.acknowledge();
}

void Capture::on_alarm(void* self) {
  Capture& capture = *static_cast<Capture*>(self);
  capture.timer_.clear_alarm();
  capture.alarm_ = true;
}

Status Capture::await(std::uint64_t timeout) {
  const marker::FunctionScope scope(marker::Function::capture);
  deadline_ = started_ + timeout;
  Status status = await_packet();
  if (status == Status::ok) status = await_picture();
  recovery_due_ = status != Status::ok;
  return status;
}

Status Capture::await_packet() {
  alarm_ = false;
  if (packet_status_ == 0) {
    timer_.set_alarm(deadline_);
    apps::sleep_until([this] { return packet_status_ != 0 || alarm_; });
    timer_.clear_alarm();
  }
  if (packet_status_ == 0) return Status::timeout;
  if (drivers::AxiDma::is_error(packet_status_)) return Status::packet_error;
  if (!has_ring_) {
    packet_bytes_ = packet_dma_.received();
    return Status::ok;
  }
  drivers::AxiDmaRing::Packet packet{};
  if (!packet_ring_.take(packet) || !packet.whole) return Status::packet_error;
  packet_bytes_ = packet.bytes;
  return Status::ok;
}

/// The picture ends before the packet, but its last burst may still be on its way.
Status Capture::await_picture() {
  std::uint32_t status = picture_dma_.acknowledge();
  while (!drivers::AxiDma::is_complete(status) && !drivers::AxiDma::is_error(status)) {
    if (timer_.now() > deadline_) return Status::picture_cut;
    status = picture_dma_.acknowledge();
  }
  if (drivers::AxiDma::is_error(status)) return Status::picture_error;
  return picture_dma_.received() == picture_bytes_ ? Status::ok : Status::picture_cut;
}

}  // namespace improved

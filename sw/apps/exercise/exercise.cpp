// Hard work for the logic of the marker designs, so that RTL beside its model shows its mistakes:
// whole frames one after the other, and between them resets in mid-frame, starts while a frame
// runs, thresholds from software, readers that are slow or not there (so FIFOs fill), transfers
// that are late, short or cut. All of it is drawn from a fixed seed: each run is the same.
#include <drivers/axi_dma.h>
#include <drivers/axi_dma_ring.h>
#include <drivers/axi_gpio.h>
#include <drivers/platform_addresses.h>
#include <drivers/timers.h>
#include <hal/hal.h>

#include <axi_dma_registers.h>
#include <blob_stream.h>
#include <marker_logic.h>

#include <cstdint>

namespace {

namespace addresses = drivers::addresses;
namespace control = marker_logic::control;
using Channel = drivers::AxiDmaConfig::Channel;

constexpr std::uint64_t counts_per_us = drivers::GlobalTimer::counts_per_second / 1'000'000;
constexpr std::uint32_t buffer_bytes = 1u << 16;     ///< of what is received and not looked at
constexpr std::uint32_t longest_upload_us = 12'000;  ///< on a slow bus it is cut
constexpr std::uint32_t most_pixels_in_full = 1u << 16, images_in_full = 4;
constexpr std::size_t most_burst_bytes =
    marker_logic::max_burst_words * marker_logic::bytes_per_word;

class Exercise {
 public:
  int run() {
    if (!initialise()) return 1;
    for (std::uint32_t image = 0; const hal_frame* frame = hal_frame_next(); ++image) {
      frame_ = *frame;
      const std::uint32_t pixels = frame->width * frame->height;
      frame_us_ = pixels / (is_thesis_ ? 50 : 100);  // at their clocks
      // Of many pixels most happens within a part of a frame as well.
      const bool in_short = pixels > most_pixels_in_full && image >= images_in_full;
      piece_us_ = in_short ? frame_us_ / 4 : frame_us_;
      if (is_thesis_ && image == 0) upload_image();
      play_whole();  // right behind that of another picture
      play(image);
      starve();
      if (!in_short) play_whole();
    }
    return 0;
  }

 private:
  bool initialise() {
    timer_.initialise();
    control_.initialise({addresses::gpio_control(), 0});
    is_thesis_ = hal_xpar("AXI_GPIO_1_BASEADDR", 0) != 0;
    if (is_thesis_) features_.initialise({addresses::gpio_features(), 0xFFFF'FFFFu});
    received_ = hal_dma_allocate(buffer_bytes, most_burst_bytes);
    picture_ = hal_dma_allocate(1u << 22, most_burst_bytes);
    set(0);
    return received_.data != nullptr && picture_.data != nullptr && reset_dma();
  }

  bool reset_dma() {
    const bool sent = image_dma_.initialise(
        {addresses::dma_image(), is_thesis_ ? Channel::memory_to_stream : Channel::stream_to_memory,
         HAL_XPAR(AXI_DMA_0_SG_LENGTH_WIDTH)});
    has_ring_ = HAL_XPAR(AXI_DMA_1_INCLUDE_SG);
    if (!has_ring_) {
      return result_dma_.initialise({addresses::dma_binary(), Channel::stream_to_memory,
                                     HAL_XPAR(AXI_DMA_1_SG_LENGTH_WIDTH)}) &&
             sent;
    }
    if (descriptors_.data == nullptr) {
      descriptors_ =
          hal_dma_allocate(2 * axi_dma::descriptor::alignment, axi_dma::descriptor::alignment);
    }
    return result_ring_.initialise(
               {addresses::dma_binary(), descriptors_, HAL_XPAR(AXI_DMA_1_SG_LENGTH_WIDTH)}) &&
           sent;
  }

  // ---- Steps

  std::uint32_t below(std::uint32_t limit) {
    random_ = random_ * 6'364'136'223'846'793'005u + 1'442'695'040'888'963'407u;
    return static_cast<std::uint32_t>((random_ >> 33) % limit);
  }
  void wait_us(std::uint32_t us) const {
    const std::uint64_t end = timer_.now() + us * counts_per_us;
    while (timer_.now() < end) {
    }
  }
  void set(std::uint32_t packet) {
    packet_ = packet;
    control_.write(packet);
  }
  void pulse(std::uint32_t bits) {
    set(packet_ | bits);
    set(packet_ & ~bits);
  }
  void reset() {
    set(packet_ & ~control::ena);
    pulse(control::rst);
  }
  void start() {
    set(packet_ & ~control::ena);
    set(packet_ | control::ena);
  }
  /// Some come with a reset, which wins.
  void give_threshold() {
    const std::uint32_t level = 20 + below(220);
    set((packet_ & ~(0xFFu << control::threshold_shift)) | level << control::threshold_shift);
    pulse(control::wr_thresh | (below(3) == 0 ? control::rst : 0));
  }
  /// One of its bits or both.
  void acknowledge() { set(packet_ ^ (1 + below(3)) << control::ready_shift); }
  /// Two images, the second from the beginning: nothing resets between them.
  void send_twice() {
    for (int i = 0; i < 2; ++i) {
      set(packet_ | control::wr_en);
      send(32);
      wait_us(3);
      set(packet_ & ~control::wr_en);
    }
  }
  /// Bytes of a burst of the thesis' stream; of improved's the most that a packet has.
  std::uint32_t result_bytes() const {
    return is_thesis_ ? marker_logic::usual_burst_words * marker_logic::bytes_per_word
                      : blob_stream::max_packet_bytes;
  }
  void take_results(std::uint32_t bytes) {
    if (has_ring_) {
      drivers::AxiDmaRing::Packet packet{};
      result_ring_.acknowledge();
      while (result_ring_.take(packet)) {
      }
      result_ring_.give(received_.bus_address, bytes);
      return;
    }
    result_dma_.acknowledge();
    result_dma_.start(received_.bus_address, bytes);
  }
  void take_picture(std::uint32_t bytes) {
    image_dma_.acknowledge();
    image_dma_.start(picture_.bus_address, bytes);
  }
  /// Of the thesis: `words` of the image go into its store, if that listens.
  void send(std::uint32_t words) {
    image_dma_.acknowledge();
    image_dma_.start(frame_.bus_address, words * marker_logic::bytes_per_word);
  }

  /// Of improved: the packet of a frame.
  bool result_is_there() const {
    const std::uint32_t status = has_ring_ ? result_ring_.status() : result_dma_.status();
    return drivers::AxiDma::is_complete(status) || drivers::AxiDma::is_error(status);
  }

  /// For so long, or until a frame is over, it does what a program does: acknowledges words, makes
  /// room for results.
  void serve(std::uint32_t us, std::uint32_t pause_us) {
    const std::uint64_t end = timer_.now() + us * counts_per_us;
    std::uint32_t last = is_thesis_ ? features_.read() : 0;
    while (timer_.now() < end) {
      if (pause_us != 0) wait_us(below(pause_us));
      if (!is_thesis_) {
        if (result_is_there()) return;
        continue;
      }
      take_results(result_bytes());
      const hal_poll_result poll = features_.poll_until_changed(last, 8, 4);
      last = poll.value;
      if (!poll.changed) continue;  // the end of the frame before may still be there
      if (last == marker_logic::WordFormat::end_of_frame) return;
      acknowledge();
    }
  }

  void upload_image() {
    const std::uint32_t bytes = frame_.width * frame_.height;
    const std::uint32_t burst = marker_logic::usual_burst_words * marker_logic::bytes_per_word;
    set(control::wr_en);
    const std::uint64_t end = timer_.now() + longest_upload_us * counts_per_us;
    for (std::uint32_t at = 0; at < bytes && timer_.now() < end; at += burst) {
      image_dma_.acknowledge();
      if (!image_dma_.start(frame_.bus_address + at, burst)) break;
      while (!drivers::AxiDma::is_complete(image_dma_.status())) {
      }
    }
    set(0);
  }

  /// A whole frame, as a program wants it, without a reset before it.
  void play_whole() {
    reset_dma();
    if (!is_thesis_) take_picture(frame_.width * frame_.height);
    take_results(result_bytes());
    start();
    if (is_thesis_) acknowledge();  // the end of the frame before
    serve(3 * frame_us_, 0);
  }

  // ---- Hard work

  void play(std::uint32_t image) {
    switch (image % 4) {
      case 0:
        return cut_frames();
      case 1:
        return fill_fifos();
      case 2:
        return be_slow();
      default:
        return do_anything();
    }
  }

  /// Resets in mid-frame, and a start soon behind each.
  void cut_frames() {
    for (int i = 0; i < 6; ++i) {
      if (!is_thesis_) take_picture(frame_.width * frame_.height);
      take_results(result_bytes());
      start();
      serve(1 + below(piece_us_ / 6), 0);
      if (i % 3 == 1) start();  // while it runs
      serve(1 + below(piece_us_ / 6), 0);
      i % 2 == 0 ? reset() : pulse(control::rst);  // then `ena` stays, and starts again
      if (i % 2 != 0) serve(1 + below(piece_us_ / 6), 0);
      if (i % 3 == 2) reset_dma();
      if (i % 2 == 1) give_threshold();
    }
  }

  /// Words, pictures and packets are not taken at first; then they are, in the middle.
  void fill_fifos() {
    reset();
    reset_dma();
    start();
    wait_us(piece_us_ / 2);
    if (!is_thesis_) take_picture(frame_.width * frame_.height);
    serve(piece_us_ / 2, 0);
    start();
    wait_us(piece_us_ + piece_us_ / 8);
    start();
    serve(piece_us_, 0);
    if (is_thesis_) {
      send_twice();
      send(500);  // to a store that does not listen
    }
    wait_us(5);
    pulse(control::wr_en);
    reset_dma();
  }

  /// There is room for a few words of what a frame gives.
  void starve() {
    reset();
    reset_dma();
    if (!is_thesis_) take_picture(frame_.width * 2);
    take_results(64);
    start();
    wait_us(piece_us_ + piece_us_ / 4);
    reset();
  }

  void be_slow() {
    reset();
    if (!is_thesis_) take_picture(frame_.width * frame_.height / 3);
    start();
    serve(piece_us_, 40);
    start();
    serve(piece_us_, 15);
    reset_dma();
  }

  void do_anything() {
    const std::uint64_t end = timer_.now() + 2 * piece_us_ * counts_per_us;
    while (timer_.now() < end) {
      act();
      wait_us(below(below(3) == 0 ? piece_us_ / 20 + 1 : 4));
    }
    reset();
    reset_dma();
  }

  void act() {
    switch (below(12)) {
      case 0:
      case 1:
        return start();
      case 2:
        return set(packet_ & ~control::ena);
      case 3:
        return below(4) == 0 ? reset() : acknowledge();
      case 4:
        return give_threshold();
      case 5:
        return is_thesis_ ? send(1 + below(90)) : take_picture(4 * (1 + below(3000)));
      case 6:
        return is_thesis_ && below(2) == 0 ? send_twice() : set(packet_ ^ control::wr_en);
      case 7:
        return below(6) == 0 ? static_cast<void>(reset_dma()) : take_results(4 * (1 + below(80)));
      case 8:
        return serve(piece_us_ / 20, below(5));
      default:
        return take_results(result_bytes());
    }
  }

  drivers::GlobalTimer timer_;
  drivers::AxiGpio control_, features_;
  drivers::AxiDma image_dma_, result_dma_;
  drivers::AxiDmaRing result_ring_;
  hal_dma_buffer received_{}, picture_{}, descriptors_{};
  hal_frame frame_{};
  std::uint32_t frame_us_ = 0;  ///< of a whole frame,
  std::uint32_t piece_us_ = 0;  ///< and of what hard work is measured by
  std::uint32_t packet_ = 0;
  std::uint64_t random_ = 20'240'607;
  bool is_thesis_ = true, has_ring_ = false;
};

Exercise exercise;

int run() {
  return exercise.run();
}

}  // namespace

const hal_program hal_program_info = {HAL_ABI, "exercise", &run,    nullptr, 0,
                                      nullptr, 0,          nullptr, 0};

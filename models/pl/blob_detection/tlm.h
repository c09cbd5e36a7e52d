#pragma once

#include <cstdint>
#include <vector>

#include <pl/blob_detection/blob_detection.h>
#include <pl/blob_detection/frame.h>
#include <pl/global_threshold/binary_view.h>

namespace pl {

/// Blob Detection at transaction level: finds a frame's blobs when it begins, and shows each on its
/// clock.
///
/// `rst` is the threshold's, too.
class BlobDetectionTlm : public BlobDetection, private BinaryListener {
 public:
  BlobDetectionTlm(sc_core::sc_module_name name, vp::Clock& clk, const Geometry& geometry,
                   BinaryView& binary);

  void settle() override;

 private:
  void edge() override;
  void binary_changed(std::uint32_t first) override;
  void reset();
  void begin(std::uint64_t cycle);
  void catch_up(std::uint64_t cycle);
  void find();
  void find_again(std::uint64_t cycle);
  void stamp(std::size_t from);
  void forget_before(std::uint64_t cycle, std::size_t from);
  void emit(std::uint64_t cycle);
  std::uint64_t next_change(std::uint64_t cycle) const;
  std::uint64_t frame_end() const { return begin_ + geometry_.pixels(); }

  BinaryView& binary_;
  BlobFrame frame_;                 ///< after the frame's last pixel
  BlobFrame start_;                 ///< at its begin, to find it again
  BlobFrame rest_;                  ///< behind its end
  std::vector<StampedBlob> blobs_;  ///< stamped with cycles; those to come from next_ on
  std::size_t next_ = 0;
  bool ena_before_ = false;
  bool begun_ = false;                              ///< a frame since the last reset
  std::uint64_t begin_ = 0;                         ///< edge that takes the frame's first pixel
  std::uint64_t idle_cycle_ = 0;                    ///< edge from which on nothing is busy
  std::uint64_t changed_cycle_ = vp::Clock::never;  ///< edge that takes the first changed pixel
};

}  // namespace pl

#include <marker/blob_packet.h>
#include <marker/work.h>

#include <blob_stream.h>

namespace marker {

std::uint32_t packet_sum(const std::uint32_t* words, std::uint32_t count) {
  std::uint32_t sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) sum = blob_stream::add_to_sum(sum, words[i]);
  work(Work::packets_summed, 1);
  work(Work::words_summed, count);
  return sum;
}

DetectionStatus BlobPacket::read(const std::uint32_t* words, std::uint32_t count) {
  const std::uint32_t* const trailer = words + count * blob_stream::words_per_blob;
  const std::uint32_t last = trailer[blob_stream::threshold];
  blobs = {words, count};
  camera_frame = trailer[blob_stream::frame_number];
  lost = trailer[blob_stream::lost];
  threshold = last & blob_stream::threshold_mask;
  if (trailer[blob_stream::blobs_sent] != count) return DetectionStatus::malformed_packet;
  if ((last & blob_stream::Checked) == 0) return DetectionStatus::ok;
  const std::uint32_t sum = packet_sum(words, blob_stream::packet_words(count) - 1);
  return last == blob_stream::checked_word(sum, threshold) ? DetectionStatus::ok
                                                           : DetectionStatus::wrong_checksum;
}

}  // namespace marker

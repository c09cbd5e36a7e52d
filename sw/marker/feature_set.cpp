#include <marker/feature_set.h>
#include <marker/work.h>

namespace marker {
namespace {

/// Start words that wait for their end word. The PL sends the two in turn; a few more allow for
/// lost words.
class OpenBlobs {
 public:
  /// Returns the number of starts that lost their chance of an end.
  std::uint32_t open(const BoundingBox& start) {
    const std::uint32_t forgotten = close(start.number, nullptr) ? 1 : 0;
    if (count_ < capacity) {
      boxes_[count_++] = start;
      return forgotten;
    }
    for (std::uint32_t i = 1; i < capacity; ++i) boxes_[i - 1] = boxes_[i];
    boxes_[capacity - 1] = start;
    return forgotten + 1;
  }

  /// Removes the start of blob `number`; false if not found.
  bool close(std::uint16_t number, BoundingBox* start) {
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (boxes_[i].number != number) continue;
      if (start != nullptr) *start = boxes_[i];
      --count_;
      for (std::uint32_t k = i; k < count_; ++k) boxes_[k] = boxes_[k + 1];
      return true;
    }
    return false;
  }

  std::uint32_t count() const { return count_; }

 private:
  static constexpr std::uint32_t capacity = 8;
  std::array<BoundingBox, capacity> boxes_{};
  std::uint32_t count_ = 0;
};

using packet::WordFormat;

std::uint16_t narrow(std::uint32_t field) {
  return static_cast<std::uint16_t>(field);
}

void end_blob(std::uint32_t word, const WordFormat& format, OpenBlobs& open, FeatureSet& features) {
  BoundingBox box{};
  if (!open.close(narrow(format.number(word)), &box)) {
    ++features.malformed;
    return;
  }
  box.ex = narrow(format.x(word));
  box.ey = narrow(format.y(word));
  if (box.ex < box.sx || box.ey < box.sy) {
    ++features.malformed;
    return;
  }
  features.push(box);
}

}  // namespace

void FeatureSet::push(const Corner& corner) {
  if (corner_count == max_corners) {
    ++lost_corners;
    return;
  }
  corners[corner_count++] = corner;
}

void FeatureSet::push(const BoundingBox& box) {
  if (blob_count == max_blobs) {
    ++lost_blobs;
    return;
  }
  blobs[blob_count++] = box;
}

void decode(const std::uint32_t* words, std::uint32_t count, const WordFormat& format,
            FeatureSet& features) {
  const FunctionScope scope(Function::decode);
  features.clear();
  OpenBlobs open;
  std::uint32_t decoded = 0;
  for (; decoded < count; ++decoded) {
    const std::uint32_t word = words[decoded];
    const WordFormat::Kind kind = WordFormat::kind(word);
    if (kind == WordFormat::Kind::end) break;
    if (kind == WordFormat::Kind::corner) {
      features.push(packet::corner(word, format));
    } else if (kind == WordFormat::Kind::blob_start) {
      features.malformed += open.open(
          {narrow(format.x(word)), narrow(format.y(word)), 0, 0, narrow(format.number(word))});
    } else {
      end_blob(word, format, open, features);
    }
  }
  features.malformed += open.count();
  work(Work::packets_decoded, decoded);
  work(Work::boxes_decoded, features.blob_count);
}

}  // namespace marker

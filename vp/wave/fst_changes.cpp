#include "fst_changes.h"

#include <algorithm>

namespace vp {

namespace {

bool read_long_number(const char*& next, const char* end, std::uint64_t& value) {
  value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    if (next == end) return false;
    const auto byte = static_cast<unsigned char>(*next++);
    value |= static_cast<std::uint64_t>(byte & 0x7fu) << shift;
    if (byte < 0x80) return true;
  }
  return false;
}

/// Reads a number of seven bits a byte. False: the bytes end within it, or it is too large.
bool read_number(const char*& next, const char* end, std::uint64_t& value) {
  // One byte or two, without a branch: which of both it is cannot be predicted.
  if (end - next < 2) return read_long_number(next, end, value);
  const auto first = static_cast<unsigned char>(next[0]);
  const auto second = static_cast<unsigned char>(next[1]);
  const unsigned has_second = first >> 7;
  if ((has_second & second >> 7) != 0) return read_long_number(next, end, value);
  value = (first & 0x7fu) | (second & (0x7fu * has_second)) << 7;
  next += 1 + has_second;
  return true;
}

bool pass(const char*& next, const char* end, std::uint64_t size) {
  if (size > static_cast<std::uint64_t>(end - next)) return false;
  next += size;
  return true;
}

/// The highest bit is the first of the first byte.
std::uint64_t packed_bits(const char* bytes, std::uint32_t width) {
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < width / 8; ++i)
    bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
  const std::uint32_t rest = width % 8;
  if (rest == 0) return bits;
  return bits << rest | static_cast<unsigned char>(bytes[width / 8]) >> (8 - rest);
}

}  // namespace

std::string_view FstChanges::text(const Change& change) {
  const char* bytes = change.bytes;
  std::uint64_t size = 0;
  read_long_number(bytes, nullptr, size);  // it ends: collect_chain() has read it
  return {bytes, static_cast<std::size_t>(size)};
}

void FstChanges::begin(std::size_t instants) {
  instants_ = instants;
  first_ = end_ = 0;
  chains_.clear();
  positions_.clear();
  due_.clear();
}

/// Reads when the chain changes next, counted from `position.due`.
template <FstChanges::Form form>
bool FstChanges::read_head(const Chain& chain, Position& position) const {
  if (position.next == chain.end) {
    position.due = never;
    return true;
  }
  std::uint64_t head = 0;
  if (!read_number(position.next, chain.end, head)) return false;
  const auto flags = form == Form::scalar ? 2 + 2 * (head & 1) : 1;
  const std::uint64_t delta = head >> flags;
  if (delta >= instants_ - position.due) return false;
  position.head = head;
  position.due += static_cast<std::uint32_t>(delta);
  return true;
}

bool FstChanges::add(const Chain& chain) {
  Position position{chain.begin, 0, 0};
  const bool good = chain.form == Form::scalar ? read_head<Form::scalar>(chain, position)
                                               : read_head<Form::vector>(chain, position);
  if (!good) return false;
  chains_.push_back(chain);
  positions_.push_back(position);
  due_.push_back(position.due);
  return true;
}

/// Sorts the changes from `first` on. False: a chain is corrupt.
bool FstChanges::fill(std::size_t first) {
  limit_ = std::clamp(chains_.size() * sorted_of_chain, fewest_sorted, most_sorted);
  for (;;) {
    const std::size_t end = std::min(instants_, first + span_);
    const Outcome outcome = collect(first, end);
    if (outcome == Outcome::corrupt) return false;
    if (outcome == Outcome::whole) {
      first_ = first;
      end_ = end;
      break;
    }
    span_ = std::max<std::size_t>(1, span_ / 2);
    for (const auto& [place, position] : before_) {
      positions_[place] = position;
      due_[place] = position.due;
    }
  }
  sort(end_ - first_);
  if (collected_.size() < limit_ / 4) span_ = std::min(span_ * 2, longest_span);
  return true;
}

/// Takes the changes before `end` off all chains.
FstChanges::Outcome FstChanges::collect(std::size_t first, std::size_t end) {
  constexpr std::size_t ahead = 8;
  collected_.clear();
  before_.clear();
  for (std::size_t place = 0; place < due_.size(); ++place) {
    if (due_[place] >= end) continue;
    // Chains lie far apart; the hardware cannot foresee the next one.
    if (place + ahead < positions_.size()) __builtin_prefetch(positions_[place + ahead].next);
    before_.emplace_back(static_cast<std::uint32_t>(place), positions_[place]);
    Outcome outcome = Outcome::whole;
    switch (chains_[place].form) {
      case Form::scalar:
        outcome = collect_chain<Form::scalar>(place, first, end);
        break;
      case Form::vector:
        outcome = collect_chain<Form::vector>(place, first, end);
        break;
      case Form::real:
        outcome = collect_chain<Form::real>(place, first, end);
        break;
      case Form::text:
        outcome = collect_chain<Form::text>(place, first, end);
        break;
    }
    if (outcome != Outcome::whole) return outcome;
    // One instant has as many changes as it has.
    if (collected_.size() > limit_ && end - first > 1) return Outcome::too_many;
  }
  return Outcome::whole;
}

template <FstChanges::Form form>
FstChanges::Outcome FstChanges::collect_chain(std::size_t place, std::size_t first,
                                              std::size_t end) {
  const Chain& chain = chains_[place];
  const std::uint32_t packed = form == Form::vector ? (chain.length + 7) / 8 : 1;
  Position position = positions_[place];
  while (position.due < end) {
    // Field by field in its place: a copy that is read back as a whole would wait for its parts.
    Change& change = collected_.emplace_back();
    change.bytes = position.next;
    change.net = chain.net;
    change.instant = static_cast<std::uint16_t>(position.due - first);
    change.form = form;
    change.head = static_cast<std::uint8_t>(position.head & 0xf);
    if constexpr (form == Form::text) {
      std::uint64_t size = 0;
      if (change.as_written() || !read_number(position.next, chain.end, size))
        return Outcome::corrupt;
      if (!pass(position.next, chain.end, size)) return Outcome::corrupt;
    } else if constexpr (form != Form::scalar) {
      if (!pass(position.next, chain.end, change.as_written() ? chain.length : packed))
        return Outcome::corrupt;
    }
    if constexpr (form == Form::vector) {
      if (!change.as_written() && chain.length <= widest_bits)
        change.bits = packed_bits(change.bytes, chain.length);
    }
    if (!read_head<form>(chain, position)) return Outcome::corrupt;
  }
  positions_[place] = position;
  due_[place] = position.due;
  return Outcome::whole;
}

/// By instant; within one they keep their order.
void FstChanges::sort(std::size_t instants) {
  starts_.assign(instants + 2, 0);
  for (const Change& change : collected_) ++starts_[change.instant + std::size_t{2}];
  for (std::size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  sorted_.resize(collected_.size());
  for (const Change& change : collected_)
    sorted_[starts_[change.instant + std::size_t{1}]++] = change;
}

}  // namespace vp

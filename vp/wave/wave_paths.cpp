#include <vp/wave_paths.h>

#include <algorithm>
#include <utility>

namespace vp {

namespace {

std::size_t take_number(const std::string& bytes, std::size_t& next) {
  std::size_t number = 0;
  for (unsigned shift = 0;; shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes[next++]);
    number |= std::size_t{byte & 0x7fu} << shift;
    if (byte < 0x80) return number;
  }
}

}  // namespace

void WavePaths::put(std::size_t number) {
  for (; number >= 0x80; number >>= 7) bytes_ += static_cast<char>(number | 0x80);
  bytes_ += static_cast<char>(number);
}

void WavePaths::push_back(std::string_view path) {
  std::size_t shared = 0;
  if (count_ % group == 0) {
    starts_.push_back(static_cast<std::uint32_t>(bytes_.size()));
  } else {
    const std::size_t most = std::min(path.size(), last_.size());
    shared = static_cast<std::size_t>(
        std::mismatch(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(most), last_.begin())
            .first -
        path.begin());
  }
  put(shared);
  put(path.size() - shared);
  bytes_ += path.substr(shared);
  last_ = path;
  ++count_;
}

std::string WavePaths::operator[](std::size_t place) const {
  const auto renamed = renamed_.find(place);
  if (renamed != renamed_.end()) return renamed->second;
  std::string path;
  std::size_t next = starts_[place / group];
  for (std::size_t i = place / group * group; i <= place; ++i) {
    path.resize(take_number(bytes_, next));
    const std::size_t rest = take_number(bytes_, next);
    path.append(bytes_, next, rest);
    next += rest;
  }
  return path;
}

WavePaths::Iterator WavePaths::begin() const {
  Iterator first(*this, 0);
  if (count_ != 0) first.decode();
  return first;
}

const std::string& WavePaths::Iterator::operator*() const {
  if (paths_->renamed_.empty()) return path_;
  const auto renamed = paths_->renamed_.find(place_);
  return renamed == paths_->renamed_.end() ? path_ : renamed->second;
}

WavePaths::Iterator& WavePaths::Iterator::operator++() {
  if (++place_ < paths_->count_) decode();
  return *this;
}

void WavePaths::Iterator::decode() {
  path_.resize(take_number(paths_->bytes_, next_));
  const std::size_t rest = take_number(paths_->bytes_, next_);
  path_.append(paths_->bytes_, next_, rest);
  next_ += rest;
}

}  // namespace vp

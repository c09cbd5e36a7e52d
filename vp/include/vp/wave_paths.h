#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vp {

/// The paths of a trace's signals, of which there may be millions. Neighbours have most of their
/// levels in common: each path is kept as what differs from the one before it, some ten bytes.
class WavePaths {
 public:
  /// Decodes from front to back.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = std::string;
    using difference_type = std::ptrdiff_t;
    using pointer = const std::string*;
    using reference = const std::string&;

    /// Valid until the iterator moves.
    const std::string& operator*() const;
    const std::string* operator->() const { return &**this; }
    Iterator& operator++();
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.place_ == b.place_; }
    friend bool operator!=(const Iterator& a, const Iterator& b) { return a.place_ != b.place_; }

   private:
    friend WavePaths;
    Iterator(const WavePaths& paths, std::size_t place) : paths_(&paths), place_(place) {}
    void decode();

    const WavePaths* paths_;
    std::size_t place_;
    std::size_t next_ = 0;  ///< byte behind `path_`
    std::string path_;
  };

  void push_back(std::string_view path);
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  std::string operator[](std::size_t place) const;
  Iterator begin() const;
  Iterator end() const { return {*this, count_}; }
  void rename(std::size_t place, std::string path) { renamed_[place] = std::move(path); }
  bool is_renamed() const { return !renamed_.empty(); }
  std::vector<std::string> all() const { return {begin(), end()}; }

 private:
  /// Paths that begin with a whole one, so that one of them is found quickly.
  static constexpr std::size_t group = 16;

  void put(std::size_t number);

  std::string bytes_;  ///< of each: letters shared with the one before, rest, letters
  std::vector<std::uint32_t> starts_;  ///< of the groups, in `bytes_`
  std::string last_;                   ///< the path that was added last
  std::size_t count_ = 0;
  std::map<std::size_t, std::string> renamed_;
};

}  // namespace vp

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "wave_declared.h"

// Names of their own for the variables of a file, and vectors of what it declares bit by bit.

namespace vp {

void WaveDeclarations::add(const WaveDeclared& declared) {
  const auto place = static_cast<std::uint32_t>(size());
  if (declared.may_join) {
    ranges.push_back({place, declared.is_single, declared.left, declared.right});
  }
  paths.push_back(declared.path);
  variables.push_back(declared.variable);
  if (declared.line == 0) return;
  std::uint64_t step = declared.line - std::exchange(last_line_, declared.line);
  for (; step >= 0x80; step >>= 7) lines += static_cast<char>(step | 0x80);
  lines += static_cast<char>(step);
}

NameTable::NameTable(std::size_t most) : places_(most * 4 / 3 + 2) {
  while (place_mask_ < most) place_mask_ = place_mask_ << 1 | 1;
}

std::uint32_t NameTable::tag_of(std::size_t hash) const {
  return static_cast<std::uint32_t>(hash) & ~place_mask_;
}

std::size_t NameTable::slot_of(std::string_view path, std::size_t hash,
                               const WavePaths& paths) const {
  const std::uint32_t tag = tag_of(hash);
  const std::size_t high = hash >> 32;
  std::size_t slot = high * places_.size() >> 32;
  for (;; slot = slot + 1 == places_.size() ? 0 : slot + 1) {
    const std::uint32_t entry = places_[slot];
    if (entry == 0) return slot;
    if ((entry & ~place_mask_) == tag && paths[(entry & place_mask_) - 1] == path) return slot;
  }
}

std::int64_t NameTable::find(std::string_view path, const WavePaths& paths) const {
  const std::uint32_t entry = places_[slot_of(path, std::hash<std::string_view>{}(path), paths)];
  return std::int64_t{entry & place_mask_} - 1;
}

std::int64_t NameTable::find_or_put(std::string_view path, const WavePaths& paths,
                                    std::size_t place) {
  const std::size_t hash = std::hash<std::string_view>{}(path);
  std::uint32_t& entry = places_[slot_of(path, hash, paths)];
  const std::int64_t found = std::int64_t{entry & place_mask_} - 1;
  if (entry == 0) entry = tag_of(hash) | static_cast<std::uint32_t>(place + 1);
  return found;
}

namespace {

std::string with_range(const std::string& path, const WaveDeclarations::Range& range) {
  std::string text = path + "[" + std::to_string(range.left);
  if (range.left != range.right) text += ":" + std::to_string(range.right);
  return text + "]";
}

/// Declarations of one name in one scope: parts of a vector, or several signals.
class Namer {
 public:
  Namer(WaveDeclarations declared, std::uint32_t nets, WaveNotes& notes)
      : all_(std::move(declared)), nets_(nets), notes_(notes), gone_(all_.size()) {}

  WaveNames names() {
    NameTable table = gather();
    // Most files have a name of its own for each signal.
    if (groups_.empty())
      return {std::move(all_.paths), std::move(all_.variables), {}, std::move(table)};
    for (auto& [first, group] : groups_) settle(group);
    return numbered();
  }

 private:
  using Place = std::uint32_t;
  using Range = WaveDeclarations::Range;

  /// Null: it cannot be a part of a vector.
  const Range* range_of(Place place) const {
    const auto found =
        std::lower_bound(all_.ranges.begin(), all_.ranges.end(), place,
                         [](const Range& range, Place wanted) { return range.place < wanted; });
    return found == all_.ranges.end() || found->place != place ? nullptr : &*found;
  }
  bool is_single(Place place) const {
    const Range* range = range_of(place);
    return range && range->is_single;
  }

  /// Finds declarations of one name. The same net again is the same signal.
  NameTable gather() {
    NameTable table(all_.size());
    Place i = 0;
    for (const std::string& path : all_.paths) {
      const std::int64_t first = table.find_or_put(path, all_.paths, i);
      if (first < 0) {
        if (is_single(i)) groups_[i] = {i};
      } else {
        add(groups_[static_cast<Place>(first)], static_cast<Place>(first), i);
      }
      ++i;
    }
    return table;
  }

  void add(std::vector<Place>& group, Place first, Place place) {
    if (group.empty()) group.push_back(first);
    const auto same = [&](Place other) {
      // One net under [15:0] and [0:15] is one signal; bits that share a net are not.
      return all_.variables[other].net == all_.variables[place].net &&
             (!is_single(other) || range_of(other)->left == left_of(place));
    };
    if (std::any_of(group.begin(), group.end(), same)) {
      gone_[place] = true;
    } else {
      group.push_back(place);
    }
  }
  std::int64_t left_of(Place place) const {
    const Range* range = range_of(place);
    return range ? range->left : 0;
  }

  void settle(std::vector<Place>& group) {
    if (group.size() > 1 && join(group)) return;
    const bool parts =
        std::all_of(group.begin(), group.end(), [&](Place place) { return range_of(place); });
    const bool any =
        std::any_of(group.begin(), group.end(), [&](Place place) { return is_single(place); });
    if (!parts || !any) return;
    for (const Place place : group)
      all_.paths.rename(place, with_range(all_.paths[place], *range_of(place)));
  }

  /// Parts that adjoin, from the left to the right, up or down.
  bool adjoin(const std::vector<Place>& group) const {
    int direction = 0;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const Range* part = range_of(group[i]);
      if (!part) return false;
      const auto go = [&](int step) {
        if (direction == 0) direction = step;
        return direction == step;
      };
      if (part->left != part->right && !go(part->left > part->right ? -1 : 1)) return false;
      if (i == 0) continue;
      const auto step = static_cast<__int128>(part->left) - range_of(group[i - 1])->right;
      if ((step != 1 && step != -1) || !go(static_cast<int>(step))) return false;
    }
    return true;
  }

  bool join(std::vector<Place>& group) {
    if (!adjoin(group)) {
      std::vector<Place> sorted = group;
      std::stable_sort(sorted.begin(), sorted.end(),
                       [&](Place a, Place b) { return left_of(a) > left_of(b); });
      if (!adjoin(sorted)) return false;
      group.swap(sorted);
    }
    std::vector<WavePart> parts;
    std::vector<std::uint64_t> key;
    unsigned width = 0;
    for (const Place place : group) {
      const WaveVariable& part = all_.variables[place];
      parts.push_back({part.net, part.width});
      key.push_back(std::uint64_t{part.net} << 32 | part.width);
      width += part.width;
      gone_[place] = true;
    }
    const auto [known, is_new] = nets_of_.emplace(std::move(key), nets_ + joined_.size());
    if (is_new) joined_.push_back(std::move(parts));
    const Place first = *std::min_element(group.begin(), group.end());
    gone_[first] = false;
    all_.variables[first].net = static_cast<std::uint32_t>(known->second);
    all_.variables[first].width = width;
    return true;
  }

  /// What is left. What has the name of another signal gets a number.
  WaveNames numbered() {
    WaveNames names{{}, {}, std::move(joined_), NameTable(all_.size())};
    std::map<std::string, unsigned> next;
    std::uint64_t line = 0;
    std::size_t next_line = 0;
    Place place = 0;
    for (auto it = all_.paths.begin(); it != all_.paths.end(); ++it, ++place) {
      if (next_line < all_.lines.size()) line += take_step(next_line);
      if (gone_[place]) continue;
      std::string path = *it;
      const auto is_taken = [&] {
        return names.table.find_or_put(path, names.paths, names.variables.size()) >= 0;
      };
      if (is_taken()) {
        notes_.add("a name is declared again with other values: it is called " +
                       shown(path + "#2") + " here",
                   line);
        const std::string base = path;
        unsigned& count = next[base];
        do {
          path = base + "#" + std::to_string(++count + 1);
        } while (is_taken());
      }
      names.paths.push_back(path);
      names.variables.push_back(all_.variables[place]);
    }
    return names;
  }

  std::uint64_t take_step(std::size_t& next) const {
    std::uint64_t step = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(all_.lines[next++]);
      step |= std::uint64_t{byte & 0x7fu} << shift;
      if (byte < 0x80) return step;
    }
  }

  WaveDeclarations all_;
  std::uint32_t nets_;
  WaveNotes& notes_;
  std::vector<bool> gone_;
  std::map<Place, std::vector<Place>> groups_;  ///< by the first of a name
  std::map<std::vector<std::uint64_t>, std::size_t> nets_of_;
  std::vector<std::vector<WavePart>> joined_;
};

}  // namespace

WaveNames named(WaveDeclarations declared, std::uint32_t nets, WaveNotes& notes) {
  return Namer(std::move(declared), nets, notes).names();
}

}  // namespace vp

#include <study/shards.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <study/kept_result.h>
#include <study/shard.h>
#include <study/shard_format.h>
#include <vp/error.h>

namespace platform::study {

namespace {

namespace fs = std::filesystem;

/// Bytes of a shard that are looked at together.
constexpr std::size_t block_bytes = 4 << 20;

std::size_t hash_of(std::string_view key) {
  return std::hash<std::string_view>()(key);
}

std::vector<double> take_values(shard::Taker& taker, std::vector<double> values) {
  const std::string_view bits = taker.take_bytes((values.size() + 7) / 8);
  for (std::size_t byte = 0; byte < bits.size(); ++byte) {
    for (auto left = static_cast<unsigned char>(bits[byte]); left != 0; left &= left - 1u) {
      const std::size_t place = byte * 8 + static_cast<std::size_t>(__builtin_ctz(left));
      values.at(place) = taker.take<double>();
    }
  }
  return values;
}

/// Opened for each look: a folder may have more shards than a process may have files open, and a
/// file that is opened anew shows what another host has added to it.
std::string bytes_of(const std::string& path, std::uint64_t offset, std::uint64_t most) {
  std::string block;
  const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);  // if it is a pipe
  struct stat facts {};
  if (file >= 0 && ::fstat(file, &facts) == 0) {
    const auto size = static_cast<std::uint64_t>(facts.st_size);
    block.resize(size > offset ? std::min(most, size - offset) : 0);
    const ssize_t got = ::pread(file, block.data(), block.size(), static_cast<off_t>(offset));
    block.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
  }
  if (file >= 0) ::close(file);
  return block;
}

/// A record of a point up to its outcome.
struct PointRecord {
  std::string_view key;
  bool failed;
  std::int64_t date;
  std::uint32_t origin;
};

PointRecord take_point(shard::Taker& taker) {
  PointRecord point{};
  if (taker.take<shard::Kind>() != shard::Kind::point) throw std::out_of_range("no point");
  point.key = taker.take_text();
  point.failed = taker.take<bool>();
  point.date = taker.take<std::int64_t>();
  point.origin = taker.take<std::uint32_t>();
  return point;
}

bool same_figures(const result::Metrics& a, const result::Metrics& b) {
  return a.names() == b.names() && a.values().size() == b.values().size() &&
         std::memcmp(a.values().data(), b.values().data(), a.values().size() * sizeof(double)) == 0;
}

}  // namespace

/// A shard as far as it was read.
struct Shards::File {
  explicit File(std::string name) : path(std::move(name)) {}

  /// False: the line is not whole, as long as its process is about to write it.
  bool read_first_line() {
    constexpr std::size_t longest = 4096;
    const std::string start = bytes_of(path, 0, longest);
    const std::size_t end = start.find('\n');
    if (end == std::string::npos && start.size() < longest) return false;
    std::istringstream words(start.substr(0, end));
    std::string name, rest;
    int number = 0;
    words >> name >> number >> engine >> host;
    std::getline(words, rest);
    program = Json::parse(rest, nullptr, false);
    if (name != shard::mark || (number == shard::version && program.is_discarded()))
      throw vp::InputError("'" + path + "' is no results of a sweep, or is damaged: move it " +
                           "elsewhere, and the sweep computes its points again");
    if (number != shard::version) {
      throw vp::InputError("'" + path + "' has version " + std::to_string(number) +
                           " of the format, this program reads version " +
                           std::to_string(shard::version) + ": sweep into another folder");
    }
    first = read = end + 1;
    return true;
  }

  /// Calls found(body, offset) for each whole record from `from` on; returns where they end.
  template <class Found>
  std::uint64_t visit(std::uint64_t from, const Found& found) {
    for (std::size_t wanted = block_bytes;;) {
      const std::string block = bytes_of(path, from, wanted);
      std::string_view rest = block;
      wanted = block_bytes;
      shard::Head head{};
      while (rest.size() >= sizeof head) {
        std::memcpy(&head, rest.data(), sizeof head);
        if (head.size == 0 || head.size > shard::most_bytes) return end_at(from);
        if (rest.size() < sizeof head + head.size) {
          wanted = std::max(wanted, sizeof head + head.size);
          break;
        }
        const std::string_view body = rest.substr(sizeof head, head.size);
        const bool was_read = from + sizeof head + head.size <= read;
        if (!was_read && shard::check_of(body) != head.check) return end_at(from);
        found(body, from + sizeof head);
        from += sizeof head + head.size;
        rest.remove_prefix(sizeof head + head.size);
      }
      if (rest.size() == block.size() && block.size() < wanted) return from;
    }
  }

  std::uint64_t end_at(std::uint64_t offset) {
    damaged = true;
    return offset;
  }

  result::Metrics take_metrics(shard::Taker& taker) const {
    const auto number = taker.take<std::uint32_t>();
    if (number == 0) return {};
    const result::Metrics& like = figures.at(number - 1);
    return {like.shared_names(), take_values(taker, like.values())};
  }

  std::string path;
  std::uint64_t first = 0;  ///< where its records begin
  std::uint64_t read = 0;   ///< up to here
  bool damaged = false;     ///< there
  std::string engine;
  std::string host;
  Json program;
  std::vector<result::Metrics> figures;
  std::vector<Setup> origins;
};

Shards::Shards(const Store& store) : store_(store.folder()) {
  refresh();
}

Shards::~Shards() = default;

void Shards::refresh() {
  std::error_code ignored;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(store_.path("runs"), ignored)) {
    if (entry.path().extension() == shard::ending) names.insert(entry.path().string());
  }
  for (const std::unique_ptr<File>& file : files_) names.erase(file->path);
  for (const std::string& name : names) {
    auto file = std::make_unique<File>(name);
    if (file->read_first_line()) files_.push_back(std::move(file));
  }
  for (std::uint32_t number = 0; number < files_.size(); ++number) scan(number);
}

void Shards::scan(std::uint32_t number) {
  File& file = *files_[number];
  if (file.damaged) return;
  std::uint64_t at = file.read;
  try {
    file.read = file.visit(file.read, [&](std::string_view body, std::uint64_t offset) {
      at = offset - sizeof(shard::Head);
      take(number, body, offset);
    });
  } catch (const std::out_of_range&) {  // whole, and yet no record
    file.read = file.end_at(at);
  }
}

void Shards::take(std::uint32_t number, std::string_view body, std::uint64_t offset) {
  File& file = *files_[number];
  shard::Taker taker(body);
  const shard::Kind kind = shard::Taker(body).take<shard::Kind>();
  if (kind == shard::Kind::figures) {
    taker.take<shard::Kind>();
    auto names = std::make_shared<result::Metrics::Names>(taker.take_count());
    for (std::string& name : *names) name = taker.take_text();
    std::vector<double> values(names->size());
    for (double& value : values) value = taker.take<double>();
    result::Metrics figures(std::move(names), std::move(values));
    for (const std::unique_ptr<File>& other : files_) {
      for (const result::Metrics& known : other->figures) figures.share_names(known);
    }
    file.figures.push_back(std::move(figures));
    return;
  }
  if (kind == shard::Kind::origin) {
    taker.take<shard::Kind>();
    file.origins.push_back(shard::take_setup(taker));
    return;
  }
  const PointRecord point = take_point(taker);
  const Place place{point.date, offset, number, static_cast<std::uint32_t>(body.size()),
                    point.failed};
  const auto [known, is_new] = places_.try_emplace(hash_of(point.key), place);
  if (is_new) return;
  if (!point.failed && !known->second.failed)
    check_equal(std::string(point.key), known->second, place);
  else if (known->second.failed && (!point.failed || known->second.date <= point.date))
    known->second = place;
}

void Shards::check_equal(const std::string& key, const Place& known, const Place& added) const {
  Block block;
  const std::optional<Outcome> one = outcome(key, known, Want::all, block);
  const std::optional<Outcome> other = outcome(key, added, Want::all, block);
  if (!one || !other || same_figures(one->metrics, other->metrics)) return;
  throw vp::InputError("'" + files_[known.file]->path + "' and '" + files_[added.file]->path +
                       "' have different results of the point " + key +
                       ", and a point has one: move one of these files elsewhere, and the sweep "
                       "computes its points again");
}

std::vector<std::string> Shards::damages() const {
  std::vector<std::string> texts;
  for (const std::unique_ptr<File>& file : files_) {
    if (file->damaged)
      texts.push_back("'" + file->path + "' is damaged from byte " + std::to_string(file->read) +
                      " on: its points from there on count as not computed");
  }
  return texts;
}

std::string_view Shards::Block::view(const File& file, std::uint64_t offset, std::size_t size) {
  constexpr std::size_t together = 1 << 16;
  constexpr std::size_t most_pieces = 64;
  if (pieces_.size() == most_pieces && pieces_.count(&file) == 0) pieces_.clear();
  Piece& piece = pieces_[&file];
  const std::uint64_t end = piece.offset + piece.bytes.size();
  const bool follows = piece.offset <= offset && offset < end + together;
  if (piece.bytes.empty() || !follows || offset + size > end) {
    piece.bytes = bytes_of(file.path, offset, follows ? std::max(size, together) : size);
    piece.offset = offset;
  }
  return std::string_view(piece.bytes).substr(offset - piece.offset, size);
}

bool Shards::has(const std::string& key) const {
  return places_.count(hash_of(key)) != 0;
}

std::optional<Outcome> Shards::outcome(const std::string& key, const Place& place, Want want,
                                       Block& block) const {
  const File& file = *files_[place.file];
  try {
    shard::Taker taker(block.view(file, place.offset, place.size));
    const PointRecord point = take_point(taker);
    if (point.key != key) return std::nullopt;
    taker.take_pairs();
    Outcome outcome;
    outcome.failed = point.failed;
    outcome.date = point.date;
    shard::take_outcome(taker, outcome);
    if (want == Want::all) outcome.metrics = file.take_metrics(taker);
    return outcome;
  } catch (const std::out_of_range&) {
    throw vp::InputError("'" + file.path + "' was changed, or is damaged: move it elsewhere, and " +
                         "the sweep computes its points again");
  }
}

std::optional<Outcome> Shards::outcome(const std::string& key, Want want, Block& block) const {
  const auto known = places_.find(hash_of(key));
  if (known == places_.end()) return std::nullopt;
  return outcome(key, known->second, want, block);
}

std::optional<Outcome> Shards::outcome(const std::string& key) const {
  Block block;
  return outcome(key, Want::all, block);
}

result::Metrics Shards::metrics(const std::string& key, Block& block) const {
  std::optional<Outcome> found = outcome(key, Want::all, block);
  return found ? std::move(found->metrics) : result::Metrics();
}

std::optional<AskedPoint> Shards::asked(const std::string& key) const {
  const auto known = places_.find(hash_of(key));
  if (known == places_.end()) return std::nullopt;
  const File& file = *files_[known->second.file];
  Block block;
  shard::Taker taker(block.view(file, known->second.offset, known->second.size));
  const PointRecord point = take_point(taker);
  if (point.key != key) return std::nullopt;
  AskedPoint asked{file.origins.at(point.origin), file.program};
  for (auto& [path, value] : taker.take_pairs()) asked.setup.settings[path] = std::move(value);
  return asked;
}

std::uint64_t Shards::of_other_versions(const Json& program, std::string& version) const {
  std::vector<bool> is_other;
  for (const std::unique_ptr<File>& file : files_) is_other.push_back(file->program != program);
  std::uint64_t count = 0;
  for (const auto& [unused, place] : places_) {
    if (!is_other[place.file]) continue;
    const Json& other = files_[place.file]->program;
    if (other.is_object()) version = other.value("version", "") + " " + other.value("revision", "");
    ++count;
  }
  return count;
}

void Shards::visit(const std::function<void(const Computation&)>& visit) const {
  for (const std::unique_ptr<File>& file : files_) {
    file->visit(file->first, [&](std::string_view body, std::uint64_t offset) {
      if (offset >= file->read || shard::Taker(body).take<shard::Kind>() != shard::Kind::point)
        return;
      shard::Taker taker(body);
      const PointRecord point = take_point(taker);
      taker.take_pairs();
      Computation found;
      found.key = point.key;
      found.engine = file->engine;
      found.host = file->host;
      found.outcome.failed = point.failed;
      found.outcome.date = point.date;
      shard::take_outcome(taker, found.outcome);
      visit(found);
    });
  }
}

void adopt_kept(const Store& store, const Manifest& manifest, Shards& shards, std::size_t first,
                const std::function<void(const std::string& file)>& on_half) {
  std::error_code ignored;
  if (!fs::is_directory(store.path("points"), ignored)) return;
  Shard own(store, manifest, "-");
  for (std::size_t i = first; i < manifest.points.size(); ++i) {
    const Point& point = manifest.points[i];
    const std::string file = store.kept_path(point.key);
    if (shards.has(point.key) || !fs::exists(file, ignored)) continue;
    try {
      own.add(point, read_kept(file).outcome);
    } catch (const HalfPoint&) {
      on_half(file);
    }
  }
  shards.refresh();
}

}  // namespace platform::study

#include "vcd_index.h"

#include <unistd.h>
#include <vp/error.h>
#include <vp/text.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "vcd_index_maker.h"

namespace vp {

/// Begins the file; numbers are those of the machine that wrote it. Behind it: the notes, a line
/// each, the places, a span for each net, the bytes of the changes.
struct VcdIndex::Header {
  std::array<char, 8> magic{'V', 'C', 'D', 'i', 'n', 'd', 'x', '1'};
  std::uint64_t byte_order = 0x0102030405060708;
  // What it belongs to.
  std::uint64_t size = 0;  ///< of the VCD
  std::int64_t time = 0;   ///< of its last change
  std::uint64_t ends = 0;  ///< sum of its first and last bytes
  std::uint64_t lenient = 0;
  // What it has.
  std::uint64_t nets = 0, places = 0, notes = 0;  ///< the last in bytes
  std::uint64_t sum = 0;                          ///< of notes and places

  bool is_of(const Header& other) const {
    return magic == other.magic && byte_order == other.byte_order && size == other.size &&
           time == other.time && ends == other.ends && lenient == other.lenient;
  }
};

/// The changes of a net in the file.
struct VcdIndex::Span {
  std::uint64_t at = 0;
  std::uint32_t count = 0;
  std::uint32_t sum = 0;
};

namespace {

namespace fs = std::filesystem;

constexpr const char* what = "index of trace";

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::uint32_t sum_of(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      crc32(before, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

/// False: these bytes are not there.
bool read_at(InputFile& file, std::uint64_t at, char* to, std::uint64_t size) {
  if (at > file.size() || size > file.size() - at) return false;
  if (::lseek(file.descriptor(), static_cast<off_t>(at), SEEK_SET) < 0) return false;
  const auto deadline = InputFile::HostClock::now() + InputFile::patience;
  for (std::uint64_t done = 0; done < size;) {
    const std::size_t count = file.read(to + done, size - done, deadline);
    if (count == 0) return false;
    done += count;
  }
  return true;
}

/// What tells one content of a VCD from another.
VcdIndex::Header key_of(const fs::path& file, const WaveOptions& options) {
  constexpr std::uint64_t end_size = 1 << 16;
  VcdIndex::Header key;
  InputFile input(file, "trace");
  key.size = input.size();
  std::error_code ignored;
  key.time = fs::last_write_time(file, ignored).time_since_epoch().count();
  key.lenient = options.lenient ? 1 : 0;
  std::string end(std::min(end_size, key.size), ' ');
  for (const std::uint64_t at : {std::uint64_t{0}, key.size - end.size()}) {
    if (!read_at(input, at, end.data(), end.size())) end.clear();
    key.ends = key.ends << 32 | sum_of(end);
  }
  return key;
}

/// Beside the VCD, or in the user's cache under a name that its path makes.
std::vector<fs::path> kept_as(const fs::path& file) {
  std::vector<fs::path> names{file.string() + ".index"};
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  if ((!cache || *cache == '\0') && (!home || *home == '\0')) return names;
  const fs::path folder = cache && *cache != '\0' ? fs::path(cache) : fs::path(home) / ".cache";
  std::error_code failed;
  const std::string path = fs::canonical(file, failed).string();
  if (failed) return names;
  names.push_back(folder / "markervp" /
                  (file.filename().string() + "-" + std::to_string(sum_of(path)) + ".index"));
  return names;
}

/// Whether something other than an index has this name: it may be a link to any file.
bool is_foreign(const fs::path& name) {
  std::error_code failed;
  const fs::file_status status = fs::symlink_status(name, failed);
  if (!fs::exists(status)) return false;
  if (!fs::is_regular_file(status)) return true;
  std::ifstream file(name, std::ios::binary);
  decltype(VcdIndex::Header::magic) magic{};
  return !file.read(magic.data(), magic.size()) || magic != VcdIndex::Header().magic;
}

/// The first of the names that can be written; empty if none can.
fs::path writable(const std::vector<fs::path>& names) {
  for (const fs::path& name : names) {
    std::error_code failed;
    if (is_foreign(name)) continue;
    if (&name != &names.front()) fs::create_directories(name.parent_path(), failed);
    if (!failed && output_problem(name.string()) == 0) return name;
  }
  return {};
}

/// What is new in `after`.
std::string new_lines(const std::vector<std::string>& before,
                      const std::vector<std::string>& after) {
  std::string lines;
  for (const std::string& text : after) {
    if (std::find(before.begin(), before.end(), text) == before.end()) lines += text + "\n";
  }
  return lines;
}

void write(const fs::path& name, VcdIndex::Header header, const VcdIndexMaker& maker,
           const std::string& notes, std::uint32_t nets) {
  header.nets = nets;
  header.places = maker.places().size();
  header.notes = notes.size();
  header.sum = sum_of(bytes_of(maker.places()), sum_of(notes));
  OutputFile file(name.string());
  file.write({reinterpret_cast<const char*>(&header), sizeof header});
  file.write(notes);
  file.write(bytes_of(maker.places()));
  std::uint64_t at = sizeof header + notes.size() + bytes_of(maker.places()).size() +
                     std::uint64_t{nets} * sizeof(VcdIndex::Span);
  for (std::uint32_t net = 0; net < nets; ++net) {
    const std::string_view changes = maker.changes_of(net);
    const VcdIndex::Span span{at,
                              static_cast<std::uint32_t>(changes.size() / sizeof(std::uint64_t)),
                              sum_of(changes, net)};
    at += changes.size();
    file.write({reinterpret_cast<const char*>(&span), sizeof span});
  }
  for (std::uint32_t net = 0; net < nets; ++net) file.write(maker.changes_of(net));
  file.commit();
}

/// Writes the index. Returns the reason if that fails, otherwise empty.
std::string make(const fs::path& file, const WaveOptions& options, const fs::path& name,
                 const VcdIndex::Header& key) {
  constexpr std::uint64_t bytes_a_change = 400, most_changes = 2'000'000;  // 2 %, 16 MB
  WaveNotes notes;
  VcdReader reader(file, options, notes);
  const std::vector<std::string> of_header = notes.texts();
  VcdIndexMaker maker(reader, std::min(most_changes, key.size / bytes_a_change));
  try {
    maker.run();
  } catch (const InputError& fault) {  // what comes before it can still be read
    return fault.what();
  }
  if (maker.places().empty()) return "it has no values";
  if (!key_of(file, options).is_of(key)) return "it changes while it is read";
  try {
    write(name, key, maker, new_lines(of_header, notes.texts()),
          static_cast<std::uint32_t>(reader.nets().size()));
  } catch (const OutputError& problem) {
    return problem.what();
  }
  return {};
}

/// The time with which a VCD ends, as its last bytes say; 0 if they do not.
std::uint64_t last_time(const fs::path& file) {
  constexpr std::uint64_t tail_size = 1 << 16;
  InputFile input(file, "trace");
  std::string tail(std::min(tail_size, input.size()), ' ');
  if (!read_at(input, input.size() - tail.size(), tail.data(), tail.size())) return 0;
  const std::size_t stamp = tail.rfind("\n#");
  std::uint64_t steps = 0;
  if (stamp != std::string::npos)
    std::from_chars(tail.data() + stamp + 2, tail.data() + tail.size(), steps);
  return steps;
}

}  // namespace

VcdIndex::VcdIndex(const fs::path& file, const fs::path& kept_as)
    : kept_as_(kept_as), input_(kept_as, std::string(what) + " '" + file.string() + "':") {}

bool VcdIndex::read(const Header& expected, WaveNotes& notes) {
  Header header;
  if (!read_at(input_, 0, reinterpret_cast<char*>(&header), sizeof header) ||
      !header.is_of(expected))
    return false;
  if (header.notes > input_.size() || header.places > input_.size() / sizeof(VcdReader::Place))
    return false;
  std::string texts(header.notes, ' ');
  places_.resize(header.places);
  const std::uint64_t size = header.places * sizeof(VcdReader::Place);
  if (!read_at(input_, sizeof header, texts.data(), texts.size()) ||
      !read_at(input_, sizeof header + texts.size(), reinterpret_cast<char*>(places_.data()), size))
    return false;
  if (header.sum != sum_of(bytes_of(places_), sum_of(texts))) return false;
  nets_ = header.nets;
  spans_at_ = sizeof header + texts.size() + size;
  for (const std::string& text : split(texts, '\n')) {
    if (!text.empty()) notes.add(text, 0);
  }
  return true;
}

std::unique_ptr<VcdIndex> VcdIndex::opened(const fs::path& file, const fs::path& name,
                                           const Header& key, WaveNotes& notes) {
  std::error_code ignored;
  if (!fs::is_regular_file(name, ignored)) return nullptr;
  std::unique_ptr<VcdIndex> index(new VcdIndex(file, name));
  if (index->read(key, notes)) return index;
  notes.add("its index '" + name.string() + "' is of another file, or damaged: it is not used", 0);
  return nullptr;
}

std::unique_ptr<VcdIndex> VcdIndex::kept(const fs::path& file, const WaveOptions& options,
                                         WaveNotes& notes) {
  const Header key = key_of(file, options);
  for (const fs::path& name : kept_as(file)) {
    if (auto index = opened(file, name, key, notes)) return index;
  }
  return nullptr;
}

std::unique_ptr<VcdIndex> VcdIndex::made(const fs::path& file, const WaveOptions& options,
                                         WaveNotes& notes) {
  const Header key = key_of(file, options);
  const fs::path name = writable(kept_as(file));
  const std::string problem = name.empty() ? "there is no folder for it that can be written"
                                           : make(file, options, name, key);
  if (problem.empty()) {
    notes.add("has an index now, '" + name.string() + "': moments in it are found at once", 0);
    return opened(file, name, key, notes);
  }
  notes.add("is read from the front, as it has no index: " + problem, 0);
  return nullptr;
}

bool VcdIndex::is_worth_it(const fs::path& file, const WaveOptions& options, std::uint64_t steps) {
  const std::uint64_t last = last_time(file);
  std::error_code failed;
  const std::uint64_t size = fs::file_size(file, failed);
  if (failed || size < options.index_from) return false;
  // Changes are taken to be as dense everywhere.
  return last == 0 ||
         static_cast<double>(steps) / static_cast<double>(last) * static_cast<double>(size) >=
             static_cast<double>(options.index_from);
}

std::optional<std::uint64_t> VcdIndex::place_before(std::uint64_t steps) const {
  const auto after = std::upper_bound(
      places_.begin(), places_.end(), steps,
      [](std::uint64_t time, const VcdReader::Place& place) { return time < place.steps; });
  if (after == places_.begin()) return std::nullopt;
  return static_cast<std::uint64_t>(after - places_.begin()) - 1;
}

std::vector<std::uint64_t> VcdIndex::last_changes(const VcdReader::Place& place,
                                                  const std::vector<std::uint32_t>& nets) {
  const auto damaged = [&] {
    throw InputError("index '" + kept_as_.string() + "' is damaged: remove it");
  };
  std::vector<std::uint64_t> found, changes;
  for (const std::uint32_t net : nets) {
    Span span;
    if (net >= nets_ || !read_at(input_, spans_at_ + net * sizeof span,
                                 reinterpret_cast<char*>(&span), sizeof span))
      damaged();
    if (span.count > input_.size() / sizeof(std::uint64_t)) damaged();
    changes.resize(span.count);
    if (!read_at(input_, span.at, reinterpret_cast<char*>(changes.data()),
                 changes.size() * sizeof(std::uint64_t)) ||
        span.sum != sum_of(bytes_of(changes), net))
      damaged();
    const auto after = std::lower_bound(changes.begin(), changes.end(), place.offset);
    if (after != changes.begin()) found.push_back(*(after - 1));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace vp

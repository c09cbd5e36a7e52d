#include <study/run_log.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <set>
#include <sstream>
#include <utility>

#include <host/process.h>
#include <study/bytes.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::study {

namespace {

namespace fs = std::filesystem;

constexpr const char* log_mark = "markervp_runs";
constexpr int log_version = 1;
constexpr const char* log_ending = ".log";

/// What a record is.
enum class RecordKind : std::uint8_t { base = 1, point = 2 };

struct Head {
  std::uint32_t size;
  std::uint32_t check;
};

/// No record is larger: names of all metrics, or a program's last words.
constexpr std::uint32_t most_bytes = 64 << 20;
/// Bytes of a log that are looked at together.
constexpr std::size_t block_bytes = 4 << 20;

/// FNV-1a: a record that a crash cut, or a disk lost, does not fit it.
std::uint32_t check_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes)
    hash = (hash ^ static_cast<unsigned char>(byte)) * std::uint64_t{0x100000001b3};
  return static_cast<std::uint32_t>(hash ^ (hash >> 32));
}

std::optional<FileMark> mark_of(const std::string& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) return std::nullopt;
  constexpr std::int64_t ns_in_a_second = 1'000'000'000;
  return FileMark{facts.st_mtim.tv_sec * ns_in_a_second + facts.st_mtim.tv_nsec,
                  static_cast<std::uint64_t>(facts.st_size)};
}

std::string node_name() {
  // Several Slurm nodes may be one machine.
  const char* const node = std::getenv("SLURMD_NODENAME");
  return node != nullptr ? node : host::host_name();
}

/// A tenth of a millisecond: no host measures finer.
double rounded(double seconds) {
  constexpr double steps = 1e4;
  return std::round(seconds * steps) / steps;
}

std::string date_text(std::int64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  ::gmtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// Values that are not those of `base`: a bit for each, then they.
void put_values(std::string& bytes, const std::vector<double>& values,
                const std::vector<double>& base) {
  const std::size_t bits = bytes.size();
  bytes.append((values.size() + 7) / 8, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::memcmp(&values[i], &base[i], sizeof values[i]) == 0) continue;
    bytes[bits + i / 8] = static_cast<char>(bytes[bits + i / 8] | 1 << i % 8);
    put(bytes, values[i]);
  }
}

std::vector<double> take_values(Taker& taker, std::vector<double> values) {
  const std::string_view bits = taker.take_bytes((values.size() + 7) / 8);
  for (std::size_t byte = 0; byte < bits.size(); ++byte) {
    for (auto left = static_cast<unsigned char>(bits[byte]); left != 0; left &= left - 1u) {
      const std::size_t place = byte * 8 + static_cast<std::size_t>(__builtin_ctz(left));
      values.at(place) = taker.take<double>();
    }
  }
  return values;
}

/// A record of a point, but for its metrics.
struct PointEntry {
  std::string key;
  FileMark mark;
  std::int64_t date = 0;
  std::int32_t attempt = 0;  ///< 0: not known
  double wall_s = 0;
  double cpu_s = 0;
  Outcome outcome;
};

void put_entry(std::string& bytes, const PointEntry& entry, const Outcome& outcome) {
  put_text(bytes, entry.key);
  put(bytes, entry.mark.time_ns);
  put(bytes, entry.mark.size);
  put(bytes, entry.date);
  put(bytes, entry.attempt);
  put(bytes, entry.wall_s);
  put(bytes, entry.cpu_s);
  put_facts(bytes, outcome);
}

PointEntry take_entry(Taker& taker) {
  PointEntry entry;
  entry.key = taker.take_text();
  entry.mark.time_ns = taker.take<std::int64_t>();
  entry.mark.size = taker.take<std::uint64_t>();
  entry.date = taker.take<std::int64_t>();
  entry.attempt = taker.take<std::int32_t>();
  entry.wall_s = taker.take<double>();
  entry.cpu_s = taker.take<double>();
  take_facts(taker, entry.outcome);
  return entry;
}

}  // namespace

RunLog::RunLog(const Store& store, const std::string& engine)
    : store_(store), engine_(engine), host_(node_name()) {}

RunLog::~RunLog() {
  if (file_ >= 0) ::close(file_);
}

void RunLog::add(const std::string& key, double wall_s, double cpu_s, int attempt,
                 const Outcome& outcome) {
  add_point(key, wall_s, cpu_s, attempt, outcome);
}

void RunLog::add_untold(const std::string& key, const Outcome& outcome) {
  add_point(key, std::nullopt, 0, 0, outcome);
}

void RunLog::add_point(const std::string& key, std::optional<double> wall_s, double cpu_s,
                       int attempt, const Outcome& outcome) {
  PointEntry entry;
  entry.key = key;
  entry.mark = mark_of(store_.point_path(key)).value_or(FileMark{});
  entry.date = std::time(nullptr);
  entry.attempt = attempt;
  entry.wall_s = rounded(wall_s.value_or(0));
  entry.cpu_s = rounded(cpu_s);
  const result::Metrics& metrics = outcome.metrics;
  const std::uint32_t base = metrics.empty() ? 0 : base_of(metrics) + 1;
  std::string body;
  put(body, static_cast<std::uint8_t>(RecordKind::point));
  put_entry(body, entry, outcome);
  put(body, base);
  if (base != 0) put_values(body, metrics.values(), bases_[base - 1].values());
  append(body);
}

std::uint32_t RunLog::base_of(const result::Metrics& metrics) {
  for (std::size_t i = bases_.size(); i-- > 0;) {
    if (metrics.shares_names(bases_[i]) || metrics.names() == bases_[i].names())
      return static_cast<std::uint32_t>(i);
  }
  std::string body;
  put(body, static_cast<std::uint8_t>(RecordKind::base));
  put(body, std::uint64_t{metrics.names().size()});
  for (const std::string& name : metrics.names()) put_text(body, name);
  for (const double value : metrics.values()) put(body, value);
  append(body);
  bases_.push_back(metrics);
  return static_cast<std::uint32_t>(bases_.size() - 1);
}

void RunLog::append(const std::string& body) {
  if (file_ < 0) open();
  const Head head{static_cast<std::uint32_t>(body.size()), check_of(body)};
  std::string bytes(reinterpret_cast<const char*>(&head), sizeof head);
  write(bytes += body);
}

void RunLog::write(const std::string& bytes) {
  if (::write(file_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    throw vp::OutputError(path_, errno);
}

void RunLog::open() {
  const std::string start = store_.path("runs/" + host_ + "-" + std::to_string(::getpid()));
  // An earlier process may have had the number.
  for (int again = 1; file_ < 0; ++again) {
    path_ = start + (again == 1 ? "" : "-" + std::to_string(again)) + log_ending;
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (file_ < 0 && errno != EEXIST) throw vp::OutputError(path_, errno);
  }
  write(std::string(log_mark) + " " + std::to_string(log_version) + " " +
        (engine_.empty() ? "-" : engine_) + " " + host_ + "\n");
}

/// A log as far as it was read.
struct RunLogs::File {
  explicit File(const std::string& name)
      : path(name), descriptor(::open(name.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  /// As many as there are.
  std::string bytes(std::uint64_t offset, std::size_t count) const {
    std::string block(count, '\0');
    const ssize_t got = ::pread(descriptor, block.data(), count, static_cast<off_t>(offset));
    block.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    return block;
  }

  bool read_first_line() {
    constexpr std::size_t longest = 1024;
    const std::string start = bytes(0, longest);
    const std::size_t end = start.find('\n');
    if (end == std::string::npos) return false;
    std::istringstream words(start.substr(0, end));
    std::string mark;
    int version = 0;
    words >> mark >> version >> engine >> host;
    first = read = end + 1;
    return mark == log_mark && version == log_version;
  }

  /// Calls found(body, offset) for each whole record from `from` on; returns where they end.
  template <class Found>
  std::uint64_t visit(std::uint64_t from, const Found& found) const {
    for (std::size_t wanted = block_bytes;;) {
      const std::string block = bytes(from, wanted);
      std::string_view rest = block;
      wanted = block_bytes;
      Head head{};
      while (rest.size() >= sizeof head) {
        std::memcpy(&head, rest.data(), sizeof head);
        if (head.size == 0 || head.size > most_bytes) return from;
        if (rest.size() < sizeof head + head.size) {
          wanted = std::max(wanted, sizeof head + head.size);
          break;
        }
        const std::string_view body = rest.substr(sizeof head, head.size);
        const bool was_read = from + sizeof head + head.size <= read;
        if (!was_read && check_of(body) != head.check) return from;
        found(body, from + sizeof head);
        from += sizeof head + head.size;
        rest.remove_prefix(sizeof head + head.size);
      }
      if (rest.size() == block.size() && block.size() < wanted) return from;
    }
  }

  result::Metrics take_metrics(Taker& taker) const {
    const auto base = taker.take<std::uint32_t>();
    if (base == 0) return {};
    const result::Metrics& found = bases.at(base - 1);
    return {found.shared_names(), take_values(taker, found.values())};
  }

  std::string path;
  int descriptor;
  std::uint64_t first = 0;  ///< where its records begin
  std::uint64_t read = 0;   ///< up to here
  std::string engine;
  std::string host;
  std::vector<result::Metrics> bases;
};

RunLogs::RunLogs(const Store& store) : store_(store.folder()) {
  refresh();
}

RunLogs::~RunLogs() = default;

void RunLogs::refresh() {
  std::error_code ignored;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(store_.path("runs"), ignored)) {
    if (entry.path().extension() == log_ending) names.insert(entry.path().string());
  }
  for (const std::unique_ptr<File>& file : files_) names.erase(file->path);
  for (const std::string& name : names) {
    auto file = std::make_unique<File>(name);
    if (file->descriptor >= 0 && file->read_first_line()) files_.push_back(std::move(file));
  }
  for (std::uint32_t number = 0; number < files_.size(); ++number) scan(number);
}

void RunLogs::scan(std::uint32_t number) {
  File& file = *files_[number];
  file.read = file.visit(file.read, [&](std::string_view body, std::uint64_t offset) {
    Taker taker(body);
    if (taker.take<std::uint8_t>() == static_cast<std::uint8_t>(RecordKind::base)) {
      auto names = std::make_shared<result::Metrics::Names>(taker.take<std::uint64_t>());
      for (std::string& name : *names) name = taker.take_text();
      std::vector<double> values(names->size());
      for (double& value : values) value = taker.take<double>();
      result::Metrics base(std::move(names), std::move(values));
      for (const std::unique_ptr<File>& other : files_) {
        for (const result::Metrics& known : other->bases) base.share_names(known);
      }
      file.bases.push_back(std::move(base));
      return;
    }
    const std::size_t hash = std::hash<std::string>()(taker.take_text());
    const Place place{taker.take<std::int64_t>(), offset, number,
                      static_cast<std::uint32_t>(body.size())};
    const auto [known, is_new] = places_.try_emplace(hash, place);
    // A point that failed may have been tried again.
    if (!is_new && known->second.time_ns <= place.time_ns) known->second = place;
  });
}

std::string_view RunLogs::Block::view(const File& file, std::uint64_t offset, std::size_t size) {
  constexpr std::size_t together = 1 << 16;
  const std::uint64_t end = offset_ + bytes_.size();
  const bool follows = file_ == &file && offset_ <= offset && offset < end + together;
  if (!follows || offset + size > end) {
    bytes_ = file.bytes(offset, follows ? std::max(size, together) : size);
    file_ = &file;
    offset_ = offset;
  }
  return std::string_view(bytes_).substr(offset - offset_, size);
}

std::optional<RunLogs::Record> RunLogs::record(const std::string& key, Want want,
                                               Block& block) const {
  const auto known = places_.find(std::hash<std::string>()(key));
  if (known == places_.end()) return std::nullopt;
  const Place& place = known->second;
  const File& file = *files_[place.file];
  const std::string_view body = block.view(file, place.offset, place.size);
  if (body.size() != place.size) return std::nullopt;
  Taker taker(body);
  taker.take<std::uint8_t>();
  PointEntry entry = take_entry(taker);
  if (entry.key != key) return std::nullopt;
  if (want == Want::all) entry.outcome.metrics = file.take_metrics(taker);
  return Record{entry.mark, std::move(entry.outcome)};
}

std::optional<Outcome> RunLogs::logged(const std::string& key) const {
  Block block;
  return logged(key, Want::all, block);
}

std::optional<Outcome> RunLogs::logged(const std::string& key, Want want, Block& block) const {
  const std::optional<FileMark> mark = mark_of(store_.point_path(key));
  if (!mark) return std::nullopt;
  std::optional<Record> found = record(key, want, block);
  if (!found || !(found->mark == *mark)) return std::nullopt;
  return std::move(found->outcome);
}

result::Metrics RunLogs::metrics(const std::string& key, Block& block) const {
  if (std::optional<Record> found = record(key, Want::all, block))
    return std::move(found->outcome.metrics);
  return outcome_of(store_.read(key)).metrics;
}

std::optional<Outcome> RunLogs::outcome(const std::string& key) const {
  Block block;
  return outcome(key, block);
}

std::optional<Outcome> RunLogs::outcome(const std::string& key, Block& block) const {
  if (std::optional<Outcome> found = logged(key, Want::all, block)) return found;
  if (!store_.has(key)) return std::nullopt;
  return outcome_of(store_.read(key));
}

void RunLogs::complete(const Manifest& manifest) {
  refresh();
  RunLog log(store_);
  for (const PlannedPoint& point : manifest.points) {
    const bool known = places_.count(std::hash<std::string>()(point.key)) != 0;
    if (!known && store_.has(point.key))
      log.add_untold(point.key, outcome_of(store_.read(point.key)));
  }
  refresh();
}

void RunLogs::visit(const std::function<void(const RunEntry&)>& visit) const {
  for (const std::unique_ptr<File>& file : files_) {
    file->visit(file->first, [&](std::string_view body, std::uint64_t) {
      Taker taker(body);
      if (taker.take<std::uint8_t>() != static_cast<std::uint8_t>(RecordKind::point)) return;
      PointEntry entry = take_entry(taker);
      RunEntry run;
      run.key = std::move(entry.key);
      if (entry.attempt != 0) {
        run.wall_s = entry.wall_s;
        run.cpu_s = entry.cpu_s;
        run.attempt = entry.attempt;
        run.engine = file->engine;
        run.host = file->host;
        run.date = date_text(entry.date);
      }
      visit(run);
    });
  }
}

}  // namespace platform::study

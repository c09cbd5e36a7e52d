#include <study/shard.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include <host/process.h>
#include <study/shard_format.h>
#include <vp/file.h>

namespace platform::study {

namespace {

std::string node_name() {
  // Several Slurm nodes may be one machine.
  const char* const node = std::getenv("SLURMD_NODENAME");
  return node != nullptr ? node : host::host_name();
}

/// Values that are not those of `first`: a bit for each, then they.
void put_values(std::string& bytes, const std::vector<double>& values,
                const std::vector<double>& first) {
  const std::size_t bits = bytes.size();
  bytes.append((values.size() + 7) / 8, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::memcmp(&values[i], &first[i], sizeof values[i]) == 0) continue;
    bytes[bits + i / 8] = static_cast<char>(bytes[bits + i / 8] | 1 << i % 8);
    shard::put(bytes, values[i]);
  }
}

}  // namespace

Shard::Shard(const Store& store, const Origins& origins, std::string engine)
    : store_(store), origins_(origins), engine_(std::move(engine)) {}

Shard::~Shard() {
  if (file_ >= 0) ::close(file_);
}

void Shard::add(const Point& point, const Outcome& outcome) {
  if (file_ < 0) open();
  const std::uint32_t origin = origin_of(point);
  const result::Metrics& metrics = outcome.metrics;
  const std::uint32_t figures = metrics.empty() ? 0 : figures_like(metrics) + 1;
  std::string body;
  shard::put(body, shard::Kind::point);
  shard::put_text(body, point.key);
  shard::put(body, outcome.failed);
  shard::put(body, outcome.date);
  shard::put(body, origin);
  shard::put_pairs(body, point.changes);
  shard::put_outcome(body, outcome);
  shard::put(body, figures);
  if (figures != 0) put_values(body, metrics.values(), figures_[figures - 1].values());
  append(body);
}

std::uint32_t Shard::origin_of(const Point& point) {
  const auto [known, is_new] = known_.try_emplace({point.family, point.input_set},
                                                  static_cast<std::uint32_t>(known_.size()));
  if (!is_new) return known->second;
  Point unchanged = point;
  unchanged.changes.clear();
  std::string body;
  shard::put(body, shard::Kind::origin);
  shard::put_setup(body, origins_.setup(unchanged));
  append(body);
  return known->second;
}

std::uint32_t Shard::figures_like(const result::Metrics& metrics) {
  for (std::size_t i = figures_.size(); i-- > 0;) {
    if (metrics.shares_names(figures_[i]) || metrics.names() == figures_[i].names())
      return static_cast<std::uint32_t>(i);
  }
  std::string body;
  shard::put(body, shard::Kind::figures);
  shard::put(body, static_cast<std::uint32_t>(metrics.names().size()));
  for (const std::string& name : metrics.names()) shard::put_text(body, name);
  for (const double value : metrics.values()) shard::put(body, value);
  append(body);
  figures_.push_back(metrics);
  return static_cast<std::uint32_t>(figures_.size() - 1);
}

void Shard::append(const std::string& body) {
  const shard::Head head{static_cast<std::uint32_t>(body.size()), shard::check_of(body)};
  std::string bytes(reinterpret_cast<const char*>(&head), sizeof head);
  write(bytes += body);
}

void Shard::write(const std::string& bytes) {
  for (std::string_view rest = bytes; !rest.empty();) {
    const ssize_t written = ::write(file_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw vp::OutputError(path_, errno);
    rest.remove_prefix(static_cast<std::size_t>(written));  // of a full disk the rest tells
  }
}

void Shard::open() {
  const std::string host = node_name();
  const std::string start = store_.path("runs/" + host + "-" + std::to_string(::getpid()));
  // An earlier process may have had the number.
  for (int again = 1; file_ < 0; ++again) {
    path_ = start + (again == 1 ? "" : "-" + std::to_string(again)) + shard::ending;
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (file_ < 0 && errno != EEXIST) throw vp::OutputError(path_, errno);
  }
  write(std::string(shard::mark) + " " + std::to_string(shard::version) + " " + engine_ + " " +
        host + " " + json_text(origins_.program) + "\n");
}

}  // namespace platform::study

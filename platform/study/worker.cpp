#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <exception>
#include <new>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <host/process.h>
#include <study/bytes.h>
#include <study/worker.h>
#include <vp/error.h>
#include <vp/file.h>

namespace platform::study {

WorkQueue::WorkQueue(std::size_t items, std::uint32_t slots)
    : items_(items), bytes_(sizeof(Shared) + slots * sizeof(Slot)) {
  void* memory = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::system_error(errno, std::generic_category(), "no memory for a sweep's processes");
  shared_ = new (memory) Shared;
  for (std::uint32_t slot = 0; slot < slots; ++slot) new (this->slots() + slot) Slot(0);
}

WorkQueue::~WorkQueue() {
  ::munmap(shared_, bytes_);
}

std::optional<std::size_t> WorkQueue::take(std::uint32_t slot) {
  const std::uint64_t item = shared_->next++;
  if (item >= items_) return std::nullopt;
  hold(slot, item);
  return item;
}

std::optional<std::size_t> WorkQueue::held(std::uint32_t slot) const {
  const std::uint64_t item = slots()[slot];
  if (item == 0) return std::nullopt;
  return item - 1;
}

std::string MessageWriter::bytes(const PointMessage& message) {
  std::string body;
  put(body, static_cast<std::uint8_t>(message.kind));
  put(body, message.item);
  put(body, message.wall_s);
  put(body, message.cpu_s);
  put_facts(body, message);
  const result::Metrics& metrics = message.metrics;
  const bool same = metrics.shares_names(before_) || metrics.names() == before_.names();
  put(body, same);
  put(body, std::uint64_t{metrics.values().size()});
  if (!same) {
    for (const std::string& name : metrics.names()) put_text(body, name);
    before_ = metrics;
  }
  for (const double value : metrics.values()) put(body, value);
  std::string bytes;
  put_text(bytes, body);
  return bytes;
}

std::optional<PointMessage> MessageReader::next() {
  std::uint64_t size = 0;
  if (waiting_.size() < sizeof size) return std::nullopt;
  std::memcpy(&size, waiting_.data(), sizeof size);
  if (waiting_.size() < sizeof size + size) return std::nullopt;
  Taker taker(std::string_view(waiting_).substr(sizeof size));
  PointMessage message;
  message.kind = static_cast<PointMessage::Kind>(taker.take<std::uint8_t>());
  message.item = taker.take<std::uint64_t>();
  message.wall_s = taker.take<double>();
  message.cpu_s = taker.take<double>();
  take_facts(taker, message);
  const bool same = taker.take<bool>();
  const auto count = taker.take<std::uint64_t>();
  std::shared_ptr<const result::Metrics::Names> names = before_.shared_names();
  if (!same) {
    auto read = std::make_shared<result::Metrics::Names>();
    for (std::uint64_t i = 0; i < count; ++i) read->push_back(taker.take_text());
    names = *read == known_.names() ? known_.shared_names() : std::move(read);
  }
  std::vector<double> values;
  values.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) values.push_back(taker.take<double>());
  message.metrics = result::Metrics(std::move(names), std::move(values));
  before_ = message.metrics;
  waiting_.erase(0, sizeof size + size);
  return message;
}

namespace {

using HostClock = std::chrono::steady_clock;

double cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What the last frame that warns at all warns of first, as the end of a message.
std::string last_warning(const Json& result) {
  const Json frames = result.value("frames", Json::array());
  for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame) {
    if (frame->contains("warnings")) return ": " + frame->at("warnings").at(0).get<std::string>();
  }
  return "";
}

/// The first parameter that the platform had with another value than the point is named after, or
/// that only one of them has.
std::string difference(const Manifest& manifest, const PlannedPoint& point,
                       const std::map<std::string, std::string>& actual) {
  std::string first;
  auto found = actual.begin();  // both are sorted
  manifest.visit_configuration(point, [&](const std::string& path, const std::string& planned) {
    if (!first.empty()) return;
    if (found != actual.end() && found->first == path && found->second == planned) {
      ++found;
    } else {
      first = found != actual.end() && found->first < path ? found->first : path;
    }
  });
  return first.empty() && found != actual.end() ? found->first : first;
}

}  // namespace

PointWorker::PointWorker(const PointList& list, WorkQueue& queue, std::uint32_t slot, int pipe)
    : list_(list), queue_(queue), slot_(slot), pipe_(pipe) {}

void PointWorker::work(std::uint32_t most) {
  for (std::uint32_t count = 0; count < most; ++count) {
    if (queue_.stopped() || host::InterruptGuard::noted()) return;
    const std::optional<std::size_t> item = queue_.take(slot_);
    if (!item || !complete(*item)) return;
  }
}

void PointWorker::work_on(std::size_t item) {
  queue_.hold(slot_, item);
  complete(item);
}

bool PointWorker::complete(std::size_t item) {
  const HostClock::time_point begin = HostClock::now();
  PointMessage message;
  try {
    message = compute(item);
  } catch (const vp::HostError& error) {
    message.kind = PointMessage::Kind::no_host;
    message.failure.message = error.what();
  }
  message.item = item;
  message.wall_s = std::chrono::duration<double>(HostClock::now() - begin).count();
  tell(message);
  queue_.release(slot_);
  return clean_;
}

PointMessage PointWorker::compute(std::size_t item) {
  const PlannedPoint& point = list_.manifest.points[list_.positions[item]];
  PointMessage message;
  const host::FileLock claim = list_.store.claim(point.key);
  if (list_.store.has(point.key)) {
    message.kind = PointMessage::Kind::there;
  } else {
    compute_claimed(point, message);
  }
  return message;
}

int PointWorker::run(const PlannedPoint& point, PointResult& result, std::ostream& said) const {
  const PointRun asked = run_of(list_.manifest, point);
  std::exception_ptr host_error;
  const auto run = [&] {
    try {
      return list_.run(asked, result, said);
    } catch (const vp::HostError&) {
      host_error = std::current_exception();
    } catch (const std::system_error& error) {
      if (!vp::HostError::is_cause(error.code())) throw;
      host_error = std::make_exception_ptr(vp::HostError(error.what()));
    }
    return static_cast<int>(host::run_failed);
  };
  const int code = host::exit_code_of(run, said);
  if (host_error) std::rethrow_exception(host_error);
  return code;
}

void PointWorker::compute_claimed(const PlannedPoint& point, PointMessage& message) {
  const double start = cpu_seconds();
  PointResult found;
  std::ostringstream said;
  const int code = run(point, found, said);
  message.cpu_s = cpu_seconds() - start;
  clean_ = code == host::done;
  std::string text = clean_ ? "" : last_line(said.str());
  if (code == host::interrupted) {
    message.kind = PointMessage::Kind::interrupted;
    return;
  }
  if (!clean_) {
    message.failed = true;
    Json result;
    if (code == host::run_failed) {
      // The program ended by itself: what it found until then says why.
      result = std::move(found.result);
      text += last_warning(result);
      message.metrics = metrics_.read(result);
    }
    message.failure = {code, 0, text};
    finish(failed_record(list_.manifest, point, message.failure, std::move(result)), message);
    return;
  }
  const std::string changed = difference(list_.manifest, point, found.configuration);
  if (!changed.empty()) {
    clean_ = false;
    message.kind = PointMessage::Kind::fault;
    message.failure = {host::run_failed, 0,
                       "the platform was built with another value than planned: " + changed};
    return;
  }
  message.metrics = metrics_.read(found.result);
  finish(done_record(list_.manifest, point, std::move(found.result)), message);
}

void PointWorker::finish(const PointRecord& record, PointMessage& message) {
  message.complaints = complaints_of(record.outcome);
  list_.store.write(record);
}

void PointWorker::tell(const PointMessage& message) {
  const std::string text = writer_.bytes(message);
  for (std::string_view bytes = text; !bytes.empty();) {
    const ssize_t count = ::write(pipe_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw std::system_error(errno, std::generic_category(), "pipe to the sweep");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace platform::study

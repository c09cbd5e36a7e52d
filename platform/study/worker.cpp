#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <new>
#include <sstream>
#include <system_error>
#include <utility>

#include <host/process.h>
#include <study/worker.h>
#include <vp/error.h>

namespace platform::study {

WorkQueue::WorkQueue(std::size_t items, std::uint32_t slots)
    : items_(items), bytes_(sizeof(Shared) + slots * sizeof(Slot) + items * sizeof(Flag)) {
  void* memory = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::system_error(errno, std::generic_category(), "no memory for a sweep's processes");
  shared_ = new (memory) Shared;
  // Zeros, as the system gives them, are slots without item and items that are not finished.
  slots_ = reinterpret_cast<Slot*>(shared_ + 1);
  finished_ = reinterpret_cast<Flag*>(slots_ + slots);
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
  const std::uint64_t item = slots_[slot];
  if (item == 0) return std::nullopt;
  return item - 1;
}

void WorkQueue::finish(std::size_t item) {
  finished_[item] = true;
  ++shared_->finished;
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const std::size_t start = text.rfind('\n', end);
  std::string line = text.substr(start == std::string::npos ? 0 : start + 1,
                                 end - (start == std::string::npos ? 0 : start + 1) + 1);
  const std::string name = "markervp: ";
  return line.rfind(name, 0) == 0 ? line.substr(name.size()) : line;
}

namespace {

using HostClock = std::chrono::steady_clock;

double cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A tenth of a millisecond: no host measures finer.
double rounded(double seconds) {
  constexpr double steps = 1e4;
  return std::round(seconds * steps) / steps;
}

/// What the last frame that warns at all warns of first, as the end of a message.
std::string last_warning(const Json& result) {
  if (!result.is_object()) return "";
  const Json frames = result.value("frames", Json::array());
  for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame) {
    if (frame->contains("warnings")) return ": " + frame->at("warnings").at(0).get<std::string>();
  }
  return "";
}

/// The first parameter that the platform had with another value than the point is named after, or
/// that only one of them has.
std::string difference(const Manifest& manifest, const Point& point,
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

PointWorker::PointWorker(const PointList& list, WorkQueue& queue, std::uint32_t slot)
    : list_(list),
      queue_(queue),
      slot_(slot),
      shard_(list.store, list.manifest, list.options.name) {}

int PointWorker::work(std::uint32_t most, std::ostream& err) {
  for (std::uint32_t count = 0; count < most; ++count) {
    if (queue_.stopped() || host::InterruptGuard::noted()) break;
    const std::optional<std::size_t> item = queue_.take(slot_);
    if (!item) break;
    const Left left = complete(*item, 1, err);
    if (left == Left::fault) return host::run_failed;
    if (left == Left::unclean) break;
  }
  return host::done;
}

int PointWorker::work_on(std::size_t item, int attempt, std::ostream& err) {
  queue_.hold(slot_, item);
  return complete(item, attempt, err) == Left::fault ? host::run_failed : host::done;
}

int PointWorker::run(const Point& point, RunResult& result, std::ostream& said) const {
  const Setup setup = list_.manifest.setup(point);
  std::exception_ptr host_error;
  const auto run = [&] {
    try {
      return list_.run(setup, result, said);
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

PointWorker::Left PointWorker::complete(std::size_t item, int attempt, std::ostream& err) {
  const Point& point = list_.manifest.points[list_.positions[item]];
  const HostClock::time_point begin = HostClock::now();
  const double start = cpu_seconds();
  RunResult found;
  std::ostringstream said;
  Outcome outcome;
  outcome.attempt = attempt;
  try {
    const int code = run(point, found, said);
    if (code == host::interrupted) {
      queue_.tell(WorkQueue::Stop::interrupted);
      return Left::unclean;
    }
    outcome.cpu_s = rounded(cpu_seconds() - start);
    outcome.failed = code != host::done;
    if (outcome.failed) outcome.failure = {code, 0, last_line(said.str())};
    if (!outcome.failed) {
      const std::string changed = difference(list_.manifest, point, found.configuration);
      if (!changed.empty()) {
        err << "the platform was built with another value than planned: " << changed;
        return Left::fault;
      }
    }
    outcome.wall_s = rounded(std::chrono::duration<double>(HostClock::now() - begin).count());
    finish(point, outcome, found);
  } catch (const vp::HostError&) {
    queue_.tell(WorkQueue::Stop::no_host);
    throw;
  }
  queue_.finish(item);
  queue_.release(slot_);
  return outcome.failed ? Left::unclean : Left::clean;
}

/// What a run that failed found until then says why, if its program ended by itself.
void PointWorker::finish(const Point& point, Outcome& outcome, RunResult& found) {
  outcome.date = std::time(nullptr);
  if (outcome.failed && outcome.failure.exit_code != host::run_failed) found.result = nullptr;
  if (outcome.failed) outcome.failure.message += last_warning(found.result);
  if (found.result.is_object()) outcome.metrics = metrics_.read(found.result);
  outcome.complaints = complaints_of(found.result);
  if (list_.options.keep_results) {
    list_.store.keep({point.key, list_.manifest.identity(point), list_.manifest.setup(point),
                      outcome, std::move(found.result)});
  }
  shard_.add(point, outcome);
}

}  // namespace platform::study

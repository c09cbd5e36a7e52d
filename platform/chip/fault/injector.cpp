#include <chip/fault/injector.h>

#include <fnmatch.h>
#include <algorithm>
#include <utility>

#include <vp/error.h>
#include <vp/parameter.h>
#include <vp/text.h>
#include <vp/unit.h>

namespace platform {

void Injector::add(const Fault& fault, const std::string& origin) {
  try {
    place(injections_.emplace_back(Injection{fault}));
  } catch (const vp::InputError& error) {
    throw vp::InputError("inject (" + origin + "): " + fault.text + ": " + error.what());
  }
}

void Injector::place(Injection& injection) {
  using What = Fault::What;
  switch (injection.fault.what) {
    case What::slverr:
    case What::decerr:
      places_.push_back(place_bus_fault(*this, injection));
      return;
    case What::corrupt:
      places_.push_back(is_stream(injection.fault.where) ? place_stream_fault(*this, injection)
                                                         : place_bus_fault(*this, injection));
      return;
    case What::dropped:
    case What::repeated:
    case What::tlast:
      places_.push_back(place_stream_fault(*this, injection));
      return;
    case What::stuck:
    case What::lost:
    case What::late:
    case What::spurious:
      places_.push_back(place_signal_fault(*this, injection));
      return;
    case What::flip:
      return plan_flip(*this, injection);
    case What::clock:
      return plan_clock_fault(*this, injection);
    case What::input:
    case What::torn:
      if (zynq_.design().input().bytes == 0) throw vp::InputError("the design takes no input");
      return;
  }
}

// A process is spawned only if there is something to do: while it waits for a time, nothing runs
// ahead of that.
void Injector::start() {
  if (!started_) sc_core::sc_spawn([this] { run(); }, sc_core::sc_gen_unique_name("injector"));
  started_ = true;
}

void Injector::plan(std::uint64_t at_ps, std::function<void()> action) {
  plans_.emplace(at_ps, std::move(action));
  start();
}

void Injector::plan_end(std::uint64_t at_ps, std::function<void()> give_up) {
  plans_.clear();
  plan(at_ps, std::move(give_up));
  zynq_.ps.cpu.give_up_at(at_ps);
}

void Injector::plan_from_edge(std::uint64_t after_ps, std::function<void()> action) {
  plans_.emplace(zynq_.scheduler.now_ps() + after_ps, std::move(action));
  zynq_.scheduler.notify(planned_);
}

// Actions happen behind the clock edges of their time: what they change is seen by later ones.
void Injector::run() {
  for (;;) {
    const std::uint64_t now = vp::to_ps(sc_core::sc_time_stamp());
    while (!plans_.empty() && plans_.begin()->first <= now) {
      const std::function<void()> action = std::move(plans_.begin()->second);
      plans_.erase(plans_.begin());
      zynq_.settle();
      action();
    }
    if (plans_.empty()) {
      sc_core::wait(planned_);
    } else {
      sc_core::wait(vp::from_ps(plans_.begin()->first - now), planned_);
    }
  }
}

namespace {

bool is_tlm(const std::string& key) {
  const auto* fidelity =
      dynamic_cast<const vp::ParameterBase*>(sc_core::sc_find_object(key.c_str()));
  return fidelity && fidelity->text() == "tlm";
}

/// "pl.a.x_*, .y": the second is below pl.a, too.
bool is_one_of(const std::string& path, const std::string& patterns) {
  std::string module;
  for (const std::string& written : vp::split(patterns, ',')) {
    std::string pattern(vp::trim(written));
    if (pattern.front() == '.') {
      pattern.insert(0, module);
    } else {
      module = pattern.substr(0, pattern.rfind('.'));
    }
    if (::fnmatch(pattern.c_str(), path.c_str(), 0) == 0) return true;
  }
  return false;
}

}  // namespace

std::string Injector::unplayed(const std::string& path) const {
  for (const trace::Vocabulary::Unplayed& unplayed : words_.unplayed) {
    if (is_tlm(unplayed.fidelity) && is_one_of(path, unplayed.signals)) return unplayed.fidelity;
  }
  // What is inside of a model of whole frames.
  const std::vector<std::string> parts = vp::split(path, '.');
  const std::string own = parts.size() > 1 ? parts[0] + ".fidelity." + parts[1] : "";
  return !own.empty() && is_tlm(own) ? own : "";
}

void check_played(const Injector& injector, const std::string& path) {
  const std::string key = injector.unplayed(path);
  if (!key.empty())
    throw vp::InputError(path + " does not move as in hardware where " + key +
                         " is tlm: set that to clocked");
}

void Injector::spoil(std::uint64_t unit, std::vector<std::uint8_t>& bytes) {
  if (unit > given_ps_.size()) given_ps_.push_back(zynq_.scheduler.now_ps());
  const std::vector<std::uint8_t> right = bytes;
  for (Injection& injection : injections_) {
    const Fault& fault = injection.fault;
    const bool torn = fault.what == Fault::What::torn;
    if (!fault.is_of_input() || !fault.meets(unit)) continue;
    const std::uint64_t size = torn ? std::min(bytes.size(), before_.size()) : bytes.size();
    const std::uint64_t first = std::min<std::uint64_t>(fault.address, size);
    const std::uint64_t count = std::min(fault.has_bytes ? fault.bytes : size, size - first);
    if (count == 0) continue;
    const auto at = static_cast<std::ptrdiff_t>(first);
    if (torn) {
      std::copy_n(before_.begin() + at, count, bytes.begin() + at);
    } else {
      std::fill_n(bytes.begin() + at, count, static_cast<std::uint8_t>(fault.value));
    }
    injection.happened(zynq_.scheduler.now_ps());
  }
  before_ = right;
}

std::uint64_t Injector::before_unit_ps(std::uint64_t unit) const {
  if (unit == 0 || unit > given_ps_.size()) return 0;
  const std::uint64_t given_ps = given_ps_[unit - 1];
  return given_ps == 0 ? 0 : given_ps - 1;
}

std::vector<facts::Injected> Injector::report() const {
  std::vector<facts::Injected> list;
  for (const Injection& injection : injections_)
    list.push_back({injection.fault.text, injection.times, injection.first_ps});
  return list;
}

}  // namespace platform

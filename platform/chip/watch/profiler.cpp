#include <chip/watch/profiler.h>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include <chip/system/hardware_map.h>
#include <vp/text.h>

namespace platform {

namespace {

using Ordered = nlohmann::ordered_json;

constexpr double ps_per_us = 1e6, ps_per_second = 1e12, nj_per_uj = 1e3;
constexpr std::uint64_t ps_per_ns = 1'000, fs_per_ps = 1'000;
constexpr const char* handlers = "interrupt handlers";

double us(std::uint64_t ps) {
  return static_cast<double>(ps) / ps_per_us;
}

}  // namespace

Profiler::Profiler(Zynq& zynq) : zynq_(zynq), functions_{{"program", program, {}}} {
  for (ps::Cpu* core : zynq.ps.cpus()) {
    const bool first = core->number() == 0;
    Course& course =
        courses_.emplace_back(Course{*core,
                                     first ? zynq.ps.gic : zynq.ps.second_core()->gic,
                                     first ? program : called(program, core->basename()),
                                     {},
                                     {},
                                     {}});
    core->on_moment([this, &course](ps::Cpu::Moment moment) { at(course, moment); });
  }
  ps::ProgramWatch::block_counts = &blocks_;
}

Profiler::~Profiler() {
  ps::ProgramWatch::block_counts = nullptr;
  for (Course& course : courses_) course.cpu.on_moment(nullptr);
}

Profiler::Mark Profiler::mark(const Course& course) {
  const ps::Cpu& cpu = course.cpu;
  return {cpu.program_time_ps(), cpu.activity().idle_ps(), cpu.work().counted()};
}

void Profiler::at(Course& course, ps::Cpu::Moment moment) {
  switch (moment) {
    case ps::Cpu::Moment::call_over: {
      const std::size_t function = under_way(course);
      ++functions_[function].self.calls;
      assign(course, function);
      break;
    }
    case ps::Cpu::Moment::handler_begins:
      begin_handler(course);
      break;
    case ps::Cpu::Moment::handler_over:
      end_handler(course);
      break;
  }
}

// What passed since the last moment. Work is counted before its time passes, but its time is the
// program's from then on; what is neither work nor sleep was spent waiting.
void Profiler::assign(Course& course, std::size_t function) {
  const Mark now = mark(course);
  const auto hertz = static_cast<double>(zynq_.ps.cpu_clk.clk.frequency_hz());
  const auto cycles = static_cast<double>(now.counted.cycles - course.last.counted.cycles) /
                      static_cast<double>(ps::LocalTime::one_cycle);
  const auto stall_fs =
      static_cast<std::uint64_t>(now.counted.stall_fs - course.last.counted.stall_fs);
  std::uint64_t left = now.time_ps - std::min(course.last.time_ps, now.time_ps);
  const auto take = [&left](std::uint64_t& to, std::uint64_t ps) {
    ps = std::min(ps, left);
    to += ps;
    left -= ps;
  };
  Cost& self = functions_[function].self;
  const std::uint64_t asleep_ps = now.idle_ps - course.last.idle_ps;
  const std::uint64_t awake_ps = left - std::min(asleep_ps, left);
  self.cycles += static_cast<double>(awake_ps) * hertz / ps_per_second;
  take(self.asleep_ps, asleep_ps);
  take(self.stall_ps, stall_fs / fs_per_ps);
  if (hertz > 0) {
    take(self.work_ps, static_cast<std::uint64_t>(std::llround(cycles / hertz * ps_per_second)));
  }
  self.waiting_ps += left;
  course.last = now;
}

// What it interrupted continues later, and is assigned then, without the handler.
void Profiler::begin_handler(Course& course) {
  course.interrupted = course.last;
  course.handler_began = course.last = mark(course);
  course.handler_began.time_ps = course.last.time_ps = zynq_.scheduler.now_ps();
  const std::vector<std::uintptr_t> calls = ps::return_addresses();
  const auto first = std::find_if(calls.begin(), calls.end(),
                                  [this](std::uintptr_t call) { return !names(call).empty(); });
  course.depth_below = static_cast<std::size_t>(calls.end() - first);
  course.in_handler = true;
  note_latency(course);
  assign(course, called(course.root, handlers));
}

void Profiler::end_handler(Course& course) {
  assign(course, called(course.root, handlers));
  handler_ps_ += course.last.time_ps - course.handler_began.time_ps;
  const auto pass_over = [&course](auto member) {
    course.interrupted.*member += course.last.*member - course.handler_began.*member;
  };
  pass_over(&Mark::time_ps);
  pass_over(&Mark::idle_ps);
  course.interrupted.counted.cycles +=
      course.last.counted.cycles - course.handler_began.counted.cycles;
  course.interrupted.counted.stall_fs +=
      course.last.counted.stall_fs - course.handler_began.counted.stall_fs;
  course.last = course.interrupted;
  course.in_handler = false;
}

void Profiler::note_latency(const Course& course) {
  const ps::Gic::Request request = course.gic.request();
  const std::uint64_t now_ps = course.cpu.program_time_ps();
  Latency& latency = latencies_[request.id];
  const std::uint64_t waited_ps = now_ps - std::min(request.since_ps, now_ps);
  ++latency.count;
  latency.total_ps += waited_ps;
  if (waited_ps > latency.worst_ps || latency.count == 1) {
    latency.worst_ps = waited_ps;
    latency.worst_at_ps = now_ps;
  }
  std::size_t bucket = 0;
  for (std::uint64_t ns = waited_ps / ps_per_ns; ns > 1 && bucket + 1 < Latency::buckets; ns /= 2)
    ++bucket;
  ++latency.counts[bucket];
}

// The functions of the program on the stack, from the outermost in.
std::size_t Profiler::under_way(const Course& course) {
  std::vector<std::uintptr_t> calls = ps::return_addresses();
  if (course.in_handler) calls.resize(calls.size() - std::min(calls.size(), course.depth_below));
  std::size_t function = course.in_handler ? called(course.root, handlers) : course.root;
  for (auto call = calls.rbegin(); call != calls.rend(); ++call) {
    const std::vector<std::string>& inlined = names(*call);
    for (auto name = inlined.rbegin(); name != inlined.rend(); ++name)
      function = called(function, *name);
  }
  return function;
}

std::size_t Profiler::called(std::size_t caller, const std::string& name) {
  const auto [known, is_new] = index_.try_emplace({caller, name}, functions_.size());
  if (is_new) functions_.push_back({name, caller, {}});
  return known->second;
}

const std::vector<std::string>& Profiler::names(std::uintptr_t address) {
  const auto [known, is_new] = names_.try_emplace(address);
  const ps::CodeLocator* code = zynq_.ps.cpu.code();
  if (is_new && code && code->contains(address)) known->second = code->functions(address);
  return known->second;
}

std::map<std::string, std::uint64_t> Profiler::calls() const {
  const ps::CodeLocator* const code = zynq_.ps.cpu.code();
  return code ? code->calls(blocks_) : std::map<std::string, std::uint64_t>();
}

namespace {

/// One profile of a file for speedscope: a stack for each function, with what it weighs.
class Weights {
 public:
  Weights(const char* name, const char* unit)
      : json_{{"type", "sampled"}, {"name", name}, {"unit", unit}, {"startValue", 0}} {}

  void add(const Ordered& stack, double weight) {
    if (weight <= 0) return;
    samples_.push_back(stack);
    weights_.push_back(weight);
    sum_ += weight;
  }
  Ordered take() {
    json_["endValue"] = sum_;
    json_["samples"] = std::move(samples_);
    json_["weights"] = std::move(weights_);
    return std::move(json_);
  }

 private:
  Ordered json_;
  Ordered samples_ = Ordered::array(), weights_ = Ordered::array();
  double sum_ = 0;
};

}  // namespace

std::string Profiler::speedscope(double nj_per_cycle) const {
  Ordered frames = Ordered::array();
  std::map<std::string, std::size_t> known;
  const auto frame = [&](const std::string& name) {
    const auto [entry, is_new] = known.try_emplace(name, frames.size());
    if (is_new) frames.push_back({{"name", name}});
    return entry->second;
  };
  Weights time("time", "microseconds"), cycles("cycles of the core", "none"),
      energy("energy of the core, uJ", "none");
  std::vector<Ordered> stacks;
  for (std::size_t i = 0; i < functions_.size(); ++i) {
    const Function& function = functions_[i];
    Ordered stack = i == program ? Ordered::array() : stacks[function.caller];
    stack.push_back(frame(function.name));
    stacks.push_back(stack);
    const Cost& self = function.self;
    time.add(stack, us(self.work_ps));
    cycles.add(stack, self.cycles);
    energy.add(stack, self.cycles * nj_per_cycle / nj_per_uj);
    for (const auto& [name, ps] : {std::pair{"[memory stalls]", self.stall_ps},
                                   std::pair{"[registers, barriers, caches]", self.waiting_ps},
                                   std::pair{"[asleep]", self.asleep_ps}}) {
      if (ps == 0) continue;
      Ordered leaf = stack;
      leaf.push_back(frame(name));
      time.add(leaf, us(ps));
    }
  }
  Weights called("calls", "none");
  for (const auto& [name, count] : calls())
    called.add(Ordered::array({frame(name)}), static_cast<double>(count));
  Ordered file;
  file["$schema"] = "https://www.speedscope.app/file-format-schema.json";
  file["name"] = "PS program";
  file["exporter"] = "markervp";
  file["activeProfileIndex"] = 0;
  file["shared"] = {{"frames", std::move(frames)}};
  file["profiles"] = Ordered::array({time.take(), cycles.take(), energy.take(), called.take()});
  return file.dump(-1, ' ', false, Ordered::error_handler_t::replace) + "\n";
}

std::string Profiler::page_json(double nj_per_cycle) {
  Ordered functions = Ordered::array();
  for (const Function& function : functions_) {
    const Cost& self = function.self;
    functions.push_back({function.name, function.caller, self.calls, us(self.work_ps),
                         us(self.stall_ps), us(self.waiting_ps), us(self.asleep_ps),
                         std::llround(self.cycles), self.cycles * nj_per_cycle / nj_per_uj});
  }
  Ordered named = Ordered::array();
  for (const ps::FunctionTime& function : zynq_.ps.cpu.activity().functions()) {
    if (function.calls == 0) continue;
    named.push_back({function.name, function.calls, us(function.self_ps), us(function.total_ps)});
  }
  Ordered interrupts = Ordered::array();
  const facts::HardwareMap map = hardware_map(zynq_);
  for (const auto& [id, latency] : latencies_) {
    std::string name = std::to_string(id);
    for (const auto& interrupt : map.interrupts) {
      if (interrupt.id == id) name += " " + interrupt.source;
    }
    Ordered counts(latency.counts);
    while (!counts.empty() && counts.back() == 0) counts.erase(counts.size() - 1);
    interrupts.push_back({{"name", name},
                          {"count", latency.count},
                          {"mean", us(latency.total_ps) / static_cast<double>(latency.count)},
                          {"worst", us(latency.worst_ps)},
                          {"worst_at", us(latency.worst_at_ps)},
                          {"counts", std::move(counts)}});
  }
  Ordered called = Ordered::object();
  for (const auto& [name, count] : calls()) called[name] = count;
  const Ordered json = {{"functions", std::move(functions)},
                        {"calls", std::move(called)},
                        {"named", std::move(named)},
                        {"handlers", us(handler_ps_)},
                        {"interrupts", std::move(interrupts)}};
  return json.dump(-1, ' ', false, Ordered::error_handler_t::replace);
}

}  // namespace platform

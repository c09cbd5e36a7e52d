#include <cli/faults/campaign.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <system_error>
#include <unordered_map>
#include <utility>

#include <chip/fault/fault_space.h>
#include <chip/fault/prospects.h>
#include <chip/run/simulation.h>
#include <cli/commands.h>
#include <cli/options.h>
#include <host/process.h>
#include <study/inputs.h>
#include <vp/error.h>
#include <vp/random.h>

namespace platform::cli {

namespace {

using Json = nlohmann::ordered_json;

/// A console's lines may hold any bytes; JSON holds UTF-8 only.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A copy that takes longer than that on the host has failed.
constexpr int longest_copy_ms = 600'000;

/// The platform of a campaign in this process, with all its inputs in memory.
class Subject {
 public:
  explicit Subject(const CampaignFile& file) : noticed_(file.noticed) {
    RunOptions options;
    options.program = file.program;
    options.fidelity = file.fidelity;
    options.configuration.design = file.design;
    for (const auto& [path, value] : file.settings)
      options.configuration.assignments.push_back(path + "=" + value);
    load_configuration(options.configuration, configuration_);
    choose_platform(options, configuration_);
    SimulationOptions asked;
    asked.program = file.program;
    asked.timeline_frames = 0;
    asked.console = &console_;
    simulation_ = build(configuration_, asked);
    const auto& classes = file.classes;
    if (std::find(classes.begin(), classes.end(), FaultSpace::on_request) != classes.end())
      let_streams_fail();
    simulation_->let_inputs_fail();
    const auto source =
        study::open_inputs({file.inputs, {}, simulation_->input(), file.repeat, {}});
    while (facts::SharedInput input = source->next()) inputs_.push_back(std::move(input));
  }

  Simulation& simulation() { return *simulation_; }
  std::uint64_t units() const { return inputs_.size(); }

  Witness run() {
    Witness witness;
    std::size_t given = 0;
    try {
      simulation_->run(
          [&] { return given < inputs_.size() ? inputs_[given++] : facts::SharedInput(); },
          [&](facts::UnitReport&& unit) {
            witness.add(unit);
            return true;
          });
    } catch (const std::exception& error) {
      witness.error = error.what();
    }
    const facts::RunFacts facts = simulation_->facts();
    if (facts.end) {
      witness.ended = !facts.end->reached_limit;
      witness.exit_code = facts.end->exit_code;
    }
    for (const std::string& warning : facts.warnings) witness.add_warning(warning);
    witness.add_console(console_.str(), noticed_);
    witness.end_ps = simulation_->zynq().scheduler.now_ps();
    return witness;
  }

 private:
  const std::vector<std::string> noticed_;
  std::ostringstream console_;
  vp::Configuration configuration_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<facts::SharedInput> inputs_;
};

/// Calls `work` in a process of its own, and returns what it makes. Throws vp::InputError with what
/// that process says of its failure.
Json in_child(const std::function<Json()>& work) {
  host::Child child([&work](std::ostream& out, std::ostream&) {
    out << text_of(work());
    return host::done;
  });
  const host::ChildEnd end = child.wait();
  if (end.exit_code != host::done)
    throw vp::InputError("the run without faults failed: " +
                         (end.err.empty() ? "a signal ended it" : end.err));
  return Json::parse(end.out);
}

/// The run without faults, and the faults that are drawn from it.
Campaign prepare(const CampaignFile& file) {
  const Json json = in_child([&file] {
    Subject subject(file);
    const Witness right = subject.run();
    if (!right.error.empty()) throw vp::InputError(right.error);
    const FaultSpace space(subject.simulation().injector(), file.classes, file.below,
                           subject.units());
    vp::RandomBits random(file.seed);
    Json shots = Json::array();
    for (std::uint64_t i = 0; i < file.count; ++i) {
      const FaultSpace::Drawn drawn = space.draw(random, 0, right.end_ps);
      shots.push_back({drawn.fault.text, drawn.of_class, drawn.module, drawn.fault.at_ps});
    }
    return Json{{"right", right.json()}, {"shots", shots}};
  });
  Campaign campaign{Witness::of(json.at("right")), {}};
  for (const Json& shot : json.at("shots"))
    campaign.shots.push_back(
        {shot[0], shot[1], shot[2], shot[3], Outcome::broken, 0, {}, Known::run});
  return campaign;
}

Fault fault_of(const Shot& shot) {
  return parse_faults("[" + shot.fault + "]", "campaign").front();
}

/// By shot, the one that is simulated for it: itself, or an earlier twin. Those that change nothing
/// have their outcome already.
std::vector<std::size_t> foresee(const CampaignFile& file, Campaign& campaign) {
  std::vector<std::size_t> simulated(campaign.shots.size());
  std::iota(simulated.begin(), simulated.end(), std::size_t{0});
  if (file.simulates_all) return simulated;
  const Json json = in_child([&] {
    Subject subject(file);
    Prospects prospects(subject.simulation().injector());
    for (const Shot& shot : campaign.shots) prospects.look_at(fault_of(shot));
    subject.run();
    Json found = Json::array();
    for (const Prospects::Prospect& one : prospects.found())
      found.push_back({one.changes_nothing, one.times, one.meets});
    return found;
  });
  std::unordered_map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < json.size(); ++i) {
    Shot& shot = campaign.shots[i];
    if (json[i][0]) {
      shot.outcome = Outcome::masked;
      shot.times = json[i][1];
      shot.known = Known::record;
    } else {
      simulated[i] = first.emplace(json[i][2], i).first->second;
      if (simulated[i] != i) shot.known = Known::twin;
    }
  }
  return simulated;
}

/// All that a process writes until it ends; nothing if it takes too long, and is ended.
std::optional<std::string> read_all(int descriptor, pid_t process) {
  std::string text;
  std::array<char, 65536> buffer{};
  for (;;) {
    pollfd wait{descriptor, POLLIN, 0};
    const int ready = ::poll(&wait, 1, longest_copy_ms);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) {
      ::kill(process, SIGKILL);
      return std::nullopt;
    }
    const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t wrote = ::write(descriptor, text.data() + done, text.size() - done);
    if (wrote <= 0) return;
    done += static_cast<std::size_t>(wrote);
  }
}

/// Runs the platform once more, and has it fork at the moment of each of its faults.
class Carrier {
 public:
  Carrier(const CampaignFile& file, const Campaign& campaign, std::ostream& out)
      : campaign_(campaign),
        out_(out),
        latest_ps_(campaign.right.end_ps + std::max(campaign.right.end_ps, file.patience_ps)),
        subject_(file) {}

  /// `mine`: places in campaign.shots.
  void run(const std::vector<std::size_t>& mine) {
    subject_.simulation().zynq().ps.cpu.read_lines();
    Injector& injector = subject_.simulation().injector();
    for (const std::size_t i : mine)
      injector.plan(campaign_.shots[i].at_ps, [this, i] { fork_for(i); });
    const Witness seen = subject_.run();
    if (copy_) finish_copy(seen);
    if (!seen.error.empty()) throw vp::InputError(seen.error);
  }

 private:
  void fork_for(std::size_t i) {
    if (copy_) return;
    std::array<int, 2> pipe{-1, -1};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "no pipe for a fault");
    out_.flush();
    const pid_t process = ::fork();
    if (process < 0)
      throw std::system_error(errno, std::generic_category(), "no process for a fault");
    if (process == 0) {
      ::close(pipe[0]);
      become_copy(i, pipe[1]);
      return;
    }
    ::close(pipe[1]);
    const std::optional<std::string> text = read_all(pipe[0], process);
    ::close(pipe[0]);
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (text && WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      out_ << *text << std::endl;
    } else {
      const std::string why = !text ? "takes too long on the host"
                              : WIFSIGNALED(status)
                                  ? "ended by signal " + std::to_string(WTERMSIG(status))
                                  : "failed";
      out_ << Json{i, to_string(Outcome::broken), 0, why}.dump() << std::endl;
    }
  }

  void become_copy(std::size_t i, int writing) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    copy_ = i;
    writing_ = writing;
    Simulation& simulation = subject_.simulation();
    simulation.injector().plan_end(latest_ps_, [] { Simulation::interrupt(); });
    try {
      simulation.zynq().ps.leave_memory_to_parent();
      simulation.inject(fault_of(campaign_.shots[i]), "campaign");
    } catch (const vp::InputError& error) {
      answer(Outcome::broken, 0, error.what());
    }
  }

  [[noreturn]] void finish_copy(const Witness& seen) {
    const std::vector<facts::Injected> injected = subject_.simulation().injector().report();
    answer(classify(campaign_.right, seen), injected.back().times, sign(campaign_.right, seen));
  }

  [[noreturn]] void answer(Outcome outcome, std::uint64_t times, const std::string& why) const {
    write_all(writing_, text_of(Json{*copy_, to_string(outcome), times, why}));
    ::_exit(0);
  }

  const Campaign& campaign_;
  std::ostream& out_;
  const std::uint64_t latest_ps_;  ///< a system that is later is not coming
  Subject subject_;
  std::optional<std::size_t> copy_;
  int writing_ = -1;
};

Outcome outcome_named(const std::string& name) {
  return *std::find_if(outcomes().begin(), outcomes().end(),
                       [&name](Outcome outcome) { return to_string(outcome) == name; });
}

/// The shots of a campaign, as they become known.
class Score {
 public:
  Score(Campaign& campaign, std::vector<std::size_t> simulated)
      : campaign_(campaign), simulated_(std::move(simulated)), done_(campaign.shots.size()) {
    for (std::size_t i = 0; i < done_.size(); ++i) {
      done_[i] = campaign.shots[i].known == Known::record;
      if (campaign.shots[i].known == Known::run) open_.push_back(i);
    }
  }

  /// Those that have to be simulated.
  const std::vector<std::size_t>& open() const { return open_; }
  std::uint64_t finished() const {
    std::uint64_t count = 0;
    for (const std::size_t i : simulated_) count += done_[i] ? 1 : 0;
    return count;
  }
  /// What a carrier wrote: a line a shot.
  void take(const std::string& lines) {
    for (std::size_t at = 0; at < lines.size();) {
      const std::size_t end = std::min(lines.find('\n', at), lines.size());
      const Json line = Json::parse(lines.begin() + static_cast<std::ptrdiff_t>(at),
                                    lines.begin() + static_cast<std::ptrdiff_t>(end));
      at = end + 1;
      const std::size_t i = line.at(0).get<std::size_t>();
      Shot& shot = campaign_.shots.at(i);
      shot.outcome = outcome_named(line.at(1));
      line.at(2).get_to(shot.times);
      line.at(3).get_to(shot.sign);
      done_.at(i) = true;
    }
  }
  /// Leaves those that are known. Of an interrupted campaign these are all up to the first that is
  /// not: those that are known without simulation would be too many.
  void close(bool is_interrupted) {
    std::vector<Shot> shots;
    for (std::size_t i = 0; i < done_.size(); ++i) {
      Shot& shot = campaign_.shots[i];
      const Shot& twin = campaign_.shots[simulated_[i]];
      if (!done_[simulated_[i]]) {
        if (is_interrupted) break;
        throw vp::InputError("nothing is known of fault " + shot.fault);
      }
      if (shot.known == Known::twin) {
        shot.outcome = twin.outcome;
        shot.times = twin.times;
        shot.sign = twin.sign;
      }
      shots.push_back(shot);
    }
    campaign_.shots = std::move(shots);
  }

 private:
  Campaign& campaign_;
  std::vector<std::size_t> simulated_;
  std::vector<bool> done_;
  std::vector<std::size_t> open_;
};

}  // namespace

const char* to_string(Known known) {
  switch (known) {
    case Known::run:
      return "run";
    case Known::record:
      return "record";
    case Known::twin:
      return "twin";
  }
  return "";
}

Campaign run_campaign(const CampaignFile& file, unsigned jobs,
                      const std::function<void(std::uint64_t)>& progress) {
  Campaign campaign = prepare(file);
  Score score(campaign, foresee(file, campaign));
  // A carrier takes some at a time, so that its process does not become large, and all are busy.
  constexpr std::size_t most_at_once = 500;
  const std::vector<std::size_t>& open = score.open();
  const std::size_t at_once =
      std::min(most_at_once, std::max<std::size_t>(1, (open.size() + jobs - 1) / jobs));
  std::size_t next = 0;
  std::vector<std::unique_ptr<host::Child>> running;
  const auto start = [&] {
    const std::size_t end = std::min(open.size(), next + at_once);
    std::vector<std::size_t> mine(open.begin() + static_cast<std::ptrdiff_t>(next),
                                  open.begin() + static_cast<std::ptrdiff_t>(end));
    next = end;
    running.push_back(
        std::make_unique<host::Child>([&file, &campaign, mine](std::ostream& out, std::ostream&) {
          Carrier(file, campaign, out).run(mine);
          return host::done;
        }));
  };
  while (next < open.size() || !running.empty()) {
    if (host::InterruptGuard::noted()) break;
    while (next < open.size() && running.size() < jobs) start();
    const auto over = std::find_if(running.begin(), running.end(),
                                   [](const auto& child) { return child->ended(); });
    if (over == running.end()) {
      ::usleep(10'000);
      continue;
    }
    const host::ChildEnd end = (*over)->wait();
    running.erase(over);
    score.take(end.out);
    if (end.exit_code != host::done)
      throw vp::InputError("a process of the campaign failed: " +
                           (end.err.empty() ? "a signal ended it" : end.err));
    progress(score.finished());
  }
  score.close(host::InterruptGuard::noted());
  return campaign;
}

}  // namespace platform::cli

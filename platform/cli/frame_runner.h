#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>

#include <chip/run/simulation.h>
#include <facts/unit.h>
#include <host/output_folder.h>
#include <result/page/report_page.h>
#include <result/result_json.h>
#include <vp/progress.h>

namespace platform::cli {

/// Where a run's inputs come from and where its reports go: between inputs, simulation, pictures,
/// console and result file. Memory does not grow with the number of units.
class FrameRunner {
 public:
  struct Outputs {
    host::OutputFolder* pictures = nullptr;  ///< gets a picture of each unit; null: none
    bool text = true;                        ///< a few lines per unit on `out`
    bool progress = false;                   ///< a bar on stderr
    std::atomic<std::uint64_t>* done;        ///< counts units; may be null
    std::ostream& out;
    result::ResultSink& result;
    page::RunExtras* page = nullptr;  ///< gets what the application shows; null: no page
  };

  /// Makes the first input, so that a bad one shows before anything else happens. Throws
  /// vp::InputError.
  explicit FrameRunner(facts::InputSource& source);

  /// Runs the simulation on all inputs. Errors of inputs, outputs and simulation are kept in
  /// error(), not thrown.
  void run(Simulation& simulation, const Outputs& outputs);

  /// What ended the run early; null if nothing did. An interrupt is none.
  std::exception_ptr error() const { return error_; }
  std::uint64_t frames() const { return frames_; }
  /// That were drawn.
  std::uint64_t pictures() const { return pictures_; }
  /// In the reports of all units.
  std::uint64_t warnings() const { return warnings_; }
  /// Units that lack something, and the first of them.
  struct Missing {
    std::uint64_t units = 0;
    std::string first;
    void add(const facts::UnitReport& unit);
  };
  /// Those that did not do their job.
  const Missing& unfulfilled() const { return unfulfilled_; }
  /// Those for which the tally of this name does not hold.
  Missing without(const std::string& tally) const;
  /// Why settings and inputs do not belong together, of the first unit that says so; empty if they
  /// do in any unit, or that is not known.
  std::string misfit() const { return fits_ ? std::string() : misfit_; }

 private:
  facts::SharedInput give();
  bool take(const facts::UnitReport& report, const Outputs& outputs);
  void write(const facts::UnitReport& report, const Outputs& outputs);
  void judge(const facts::UnitReport& report);

  facts::InputSource& source_;
  facts::SharedInput first_;
  std::unique_ptr<vp::Progress> progress_;
  std::exception_ptr error_;
  std::uint64_t frames_ = 0;
  std::uint64_t pictures_ = 0;
  std::uint64_t warnings_ = 0;
  Missing unfulfilled_;
  std::map<std::string, Missing> without_;  ///< of the required tallies
  std::string misfit_;
  bool fits_ = false;
};

}  // namespace platform::cli

// How a run went, how fast it was, and what set its rate, in result.json.
#include <result/result_members.h>

#include <string>

namespace platform::result {

using facts::Better;

namespace {

constexpr int fps_places = 6;

double us(std::uint64_t ps) {
  return static_cast<double>(ps) / facts::ps_per_us;
}

std::optional<std::vector<std::string>> unless_none(const std::vector<std::string>& list) {
  return list.empty() ? std::nullopt : std::optional(list);
}

Members<facts::Injected> injected_members() {
  using facts::Injected;
  return Members<Injected>()
      .text("fault", &Injected::fault)
      .figure({"times", "1", "how often a fault that was asked for happened"}, &Injected::times)
      .figure(
          {"first_us", "µs", "when it did first"},
          [](const Injected& injected) {
            return injected.times > 0 ? std::optional(us(injected.first_ps)) : std::nullopt;
          },
          us_places);
}

Members<facts::ProgramEnd> program_end_members() {
  using facts::ProgramEnd;
  return Members<ProgramEnd>()
      .figure({"exit_code", "1", "what the PS program returned"}, &ProgramEnd::exit_code)
      .figure(
          {"time_us", "µs", "when it ended", Better::less},
          [](const ProgramEnd& end) { return us(end.ps); }, us_places)
      .figure({"reached_limit", "1", "1 if it was in an endless loop when its time was up"},
              [](const ProgramEnd& end) {
                return end.reached_limit ? std::optional(true) : std::nullopt;
              })
      .figure(
          {"main_us", "µs",
           "when main() returned, if interrupts or the other core had work after it"},
          [](const ProgramEnd& end) {
            return end.main_ps ? std::optional(us(*end.main_ps)) : std::nullopt;
          },
          us_places);
}

Members<facts::Summary::Stage> stage_members() {
  using Stage = facts::Summary::Stage;
  return Members<Stage>()
      .text("name", &Stage::name)
      .text("part_of", unless_empty(&Stage::part_of))
      .text("clock", unless_empty(&Stage::clock))
      .text("why", unless_empty(&Stage::why));
}

Members<facts::Summary> rate_members() {
  using facts::Summary;
  const facts::Figure mean("mean", "1/s", "frame rate: results over the time that they took",
                           Better::more, "Frame rate");
  return Members<Summary>()
      .figure(mean.shown_in("frames/s", 1), &Summary::mean_fps, fps_places)
      .figure(
          {"min", "1/s", "frame rate of the slowest result", Better::more},
          [](const Summary& summary) { return summary.fps().min(); }, fps_places)
      .figure(
          {"max", "1/s", "frame rate of the fastest result", Better::more},
          [](const Summary& summary) { return summary.fps().max(); }, fps_places);
}

Members<facts::Summary> latency_members() {
  using facts::Summary;
  constexpr double ms_per_us = 1e-3;
  const facts::Figure mean("mean", "µs", "from the start of a frame to its result", Better::less,
                           "Latency");
  return Members<Summary>()
      .figure(
          mean.shown_in("ms", ms_per_us),
          [](const Summary& summary) { return summary.latency_us().mean(); }, us_places)
      .figure(
          {"max", "µs", "the same of the slowest", Better::less},
          [](const Summary& summary) { return summary.latency_us().max(); }, us_places);
}

Members<WholeRun> summary_members() {
  const auto with_result = [](const WholeRun& run) {
    return run.summary.fps().count() > 0 ? &run.summary : nullptr;
  };
  const auto power = [](const WholeRun& run) { return if_known(run.facts.power); };
  return Members<WholeRun>()
      .figure({"frames", "1", "frames that the software worked on", Better::neither, "Frames"},
              [](const WholeRun& run) { return run.summary.frames(); })
      .figure({"delivered", "1", "of them with a result", Better::more, "Frames with a result"},
              [](const WholeRun& run) { return run.summary.delivered(); })
      .own([](const WholeRun& run, Json& json) {
        for (const facts::Tally& tally : run.facts.work.tallies) {
          if (tally.is_figure) json[tally.name] = run.summary.tally(tally.name);
        }
      })
      .object("fps", rate_members(), with_result)
      .object("latency_us", latency_members(), with_result)
      .object("power_w", power_summary_members(), power)
      .figure(
          {"energy_per_frame_mj", "mJ", "energy of the chip for one frame", Better::less,
           "Energy per frame"},
          [](const WholeRun& run) {
            const auto& known = run.facts.power;
            return known && known->per_frame ? std::optional(known->energy_per_frame_mj)
                                             : std::nullopt;
          },
          energy_places)
      .figure({"unpublished", "1", "frames of which the software said nothing, if there are any",
               Better::less},
              [](const WholeRun& run) {
                return run.facts.unpublished > 0 ? std::optional(run.facts.unpublished)
                                                 : std::nullopt;
              });
}

/// A limit, and the work that it limits.
struct WorkLimit {
  facts::Limit limit;
  const facts::Work& work;
};

Members<WorkLimit> limit_members() {
  return Members<WorkLimit>()
      .text("kind", [](const WorkLimit& of) { return facts::to_string(of.limit.kind); })
      .text("stages", [](const WorkLimit& of) { return of.limit.stages; })
      .figure(
          {"stages_us", "µs", "time of the stages that set the frame rate", Better::less},
          [](const WorkLimit& of) { return of.limit.stages_us; }, us_places)
      .figure(
          {"period_us", "µs", "time from result to result that they set", Better::less},
          [](const WorkLimit& of) { return of.limit.period_us; }, us_places)
      .named(
          "percent",
          {{"*", "%", "share of the run in which a stage, or the camera, sets the frame rate"}},
          [](const WorkLimit& of, const auto& found) {
            for (const auto& [name, share] : of.limit.percent) found(name, share);
          },
          percent_places)
      .with(Members<facts::Limit>()
                .text("clock", unless_empty(&facts::Limit::clock))
                .text("why", unless_empty(&facts::Limit::why))
                .text("levers", &facts::Limit::levers),
            [](const WorkLimit& of) { return &of.limit; })
      .text("text", [](const WorkLimit& of) { return of.limit.text(of.work); })
      .text("faster_with", [](const WorkLimit& of) { return of.limit.levers_text(); });
}

Members<facts::CameraReport> slack_members() {
  using facts::CameraReport;
  return Members<CameraReport>()
      .figure(
          {"mean", "µs", "what a frame leaves of the camera's period", Better::more},
          [](const CameraReport& camera) {
            return (camera.period_ps() - camera.busy_ps) / facts::ps_per_us;
          },
          us_places)
      .figure(
          {"min", "µs", "the same of the longest frame", Better::more},
          [](const CameraReport& camera) {
            return (camera.period_ps() - camera.most_busy_ps) / facts::ps_per_us;
          },
          us_places);
}

Members<WholeRun> camera_members() {
  using facts::CameraReport;
  const auto camera = [](const WholeRun& run) { return &*run.facts.camera; };
  return Members<WholeRun>()
      .with(
          Members<CameraReport>()
              .figure({"rate_fps", "1/s", "rate of the camera"}, &CameraReport::rate_fps,
                      fps_places)
              .figure({"offered", "1", "frames that came from it"}, &CameraReport::offered)
              .figure({"dropped", "1", "of them those that found the software busy", Better::less},
                      &CameraReport::dropped),
          camera)
      .figure(
          {"delivered_fps", "1/s", "results over the time of the camera's frames", Better::more},
          [](const WholeRun& run) { return run.summary.mean_fps(); }, fps_places)
      .with(
          Members<CameraReport>()
              .figure({"utilisation_percent", "%",
                       "share of the camera's period in which the software is busy", Better::less},
                      &CameraReport::utilisation_percent, percent_places)
              .group("slack_us", slack_members()),
          camera);
}

}  // namespace

const Members<facts::RunFacts>& end_members() {
  using facts::RunFacts;
  static const Members<RunFacts> members =
      Members<RunFacts>()
          .text("notes", [](const RunFacts& facts) { return unless_none(facts.notes); })
          .list("injected", injected_members(), &RunFacts::injected, false)
          .text("incomplete", &RunFacts::incomplete)
          .object("program_end", program_end_members(),
                  [](const RunFacts& facts) { return if_known(facts.end); });
  return members;
}

namespace {

std::optional<WorkLimit> limit_of(const WholeRun& run) {
  if (const std::optional<facts::Limit> limit = run.summary.limit())
    return WorkLimit{*limit, run.facts.work};
  return std::nullopt;
}

}  // namespace

const Members<WholeRun>& figure_members() {
  static const Members<WholeRun> members =
      Members<WholeRun>()
          .list(
              "stages", stage_members(), [](const WholeRun& run) { return run.summary.stages(); },
              false)
          .group("summary", summary_members())
          .object("limit", limit_members(), limit_of)
          .object("camera", camera_members(),
                  [](const WholeRun& run) { return run.facts.camera ? &run : nullptr; })
          .object(
              "verdict", verdict_members(),
              [](const WholeRun& run) { return std::optional(verdict_of(run.facts, run.summary)); })
          .object("power", power_members(),
                  [](const WholeRun& run) { return if_known(run.facts.power); })
          .object("resources", resource_members(),
                  [](const WholeRun& run) { return if_known(run.facts.resources); })
          .object("timing", timing_members(),
                  [](const WholeRun& run) { return if_known(run.facts.timing); })
          .object("clocks", clock_members(),
                  [](const WholeRun& run) { return if_known(run.facts.clocks); });
  return members;
}

}  // namespace platform::result

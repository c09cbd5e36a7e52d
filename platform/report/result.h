#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <marker/packet.h>
#include <report/design_report.h>
#include <scene/camera.h>
#include <scene/pose.h>
#include <scene/scene.h>

/// What a run found, as plain values: filled by the session that runs the platform, read by
/// result.json, the console and the pictures. No simulation inside.
namespace platform::report {

/// Counted per frame; the overflow counters are those of SPEC "Overflow counters", read at the
/// frame's end.
struct Counts {
  std::uint64_t corners = 0;        ///< corner words received
  std::uint64_t blobs = 0;          ///< blobs received
  std::uint64_t feature_words = 0;  ///< words received, the end word included
  std::uint64_t candidates = 0;     ///< blobs with a corner in each quadrant
  std::uint64_t feature_overflow = 0;
  std::uint64_t label_overflow = 0;
  std::uint64_t bridge_overflow = 0;
  std::uint64_t crossing_overflow = 0;
  /// Words, corners, blobs and candidates for which the software had no room.
  std::uint64_t software_overflow = 0;
  std::uint64_t malformed = 0;  ///< blob words without partner, boxes that end before they start

  /// What found no room, or was damaged by that.
  std::uint64_t lost() const {
    return feature_overflow + label_overflow + bridge_overflow + crossing_overflow +
           software_overflow + malformed;
  }
};

/// A marker that the software identified.
struct FoundMarker {
  int id = 0;
  int rotation = 0;                      ///< quarter turns clockwise from upright, 0 to 3
  std::array<PixelPoint, 4> corners_px;  ///< clockwise from the marker's own top left
  bool has_pose = true;                  ///< false: the corners admit no pose
  Pose pose;
  double reprojection_px = 0;  ///< mean distance of the corners from their projections
  std::uint32_t iterations = 0;
};

/// What a picture shows besides the marker. Not part of result.json.
struct Features {
  std::vector<marker::Corner> corners;
  std::vector<marker::BoundingBox> blobs;
  /// Corners of each candidate as pixel indices, clockwise from the top left.
  std::vector<std::array<PixelPoint, 4>> candidates;
};

/// Simulated time that one stage took, ps. The name is the key in `time_us`: "upload",
/// "feature_extraction", …
struct StageTime {
  std::string name;
  std::uint64_t ps = 0;
  std::uint64_t start_ps = 0;  ///< when it began; not part of result.json
  std::string part_of = {};    ///< the stage whose time contains this one's; empty: none
};

/// True if other stages of the list are parts of `stage`: what is shown as parts of a whole leaves
/// it out.
bool has_parts(const std::vector<StageTime>& stages, const std::string& stage);

/// One image and what came of it.
struct FrameReport {
  std::string input;            ///< name of the input, no path
  std::uint32_t index = 0;      ///< 0, 1, 2 … in the order of the run
  std::uint32_t threshold = 0;  ///< grey level at which this frame was made binary
  Counts counts;
  std::vector<FoundMarker> markers;
  std::optional<GroundTruth> truth;  ///< of the scene's marker, where known
  std::vector<StageTime> times;      ///< in the order of the flow; "frame" and "upload" among them
  std::uint64_t start_ps = 0;   ///< simulated time at which work on the frame began, upload done
  std::uint64_t end_ps = 0;     ///< simulated time of its last result
  std::uint64_t upload_ps = 0;  ///< time before `start_ps` in which the image was only uploaded
  std::string gave_up;          ///< why the software gave the frame up; empty: it has a result
  std::vector<GroupEnergy> energy;  ///< its period's, upload excluded; empty: not known
  std::vector<std::string> warnings;
  Camera camera;      ///< that took the image
  Features features;  ///< dropped once the picture is drawn

  /// Whether a result was delivered: only such frames make rates, latency and energy.
  bool delivered() const { return gave_up.empty(); }
};

/// How the PS program ended.
struct ProgramEnd {
  int exit_code = 0;     ///< what it returned; 0: all went well
  std::uint64_t ps = 0;  ///< when, in simulated time
};

/// The design point that ran.
struct RunFacts {
  std::string fidelity;                                  ///< "tlm" or "clocked"
  std::string system;                                    ///< "hybrid" or "ps-only"
  std::string design;                                    ///< which IP variants: "thesis"
  std::string profile;                                   ///< cost table of the software
  std::map<std::string, std::string> configuration;      ///< path -> "value unit"
  std::optional<ProgramEnd> end = std::nullopt;          ///< of the program; none: it was stopped
  std::optional<std::string> incomplete = std::nullopt;  ///< why the run ended early, if it did
  // What the design costs; none: not known.
  std::optional<PowerReport> power = std::nullopt;
  std::optional<ResourceReport> resources = std::nullopt;
  std::optional<TimingReport> timing = std::nullopt;
  std::optional<ClockReport> clocks = std::nullopt;
  std::vector<std::string> warnings = {};  ///< that belong to no frame
};

/// Everything that may differ between two runs of the same design point on the same inputs.
struct Provenance {
  std::string program;             ///< "markervp"
  std::string version;             ///< of the program
  std::string revision;            ///< of its sources, as git describes it; may be empty
  std::string configuration_hash;  ///< 16 hexadecimal digits
  std::vector<std::string> command_line;
  std::string host;
  std::string date;        ///< start of the run, UTC, ISO 8601
  double wall_time_s = 0;  ///< of the whole run
  /// Further facts by name, in order: "output", "trace", "camera" …
  std::vector<std::pair<std::string, std::string>> details;
};

}  // namespace platform::report

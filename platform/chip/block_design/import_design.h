#pragma once

#include <string>
#include <utility>
#include <vector>

#include <chip/block_design/shelf.h>
#include <chip/handoff/handoff.h>
#include <chip/handoff/own_driver.h>
#include <chip/handoff/rtl_sources.h>

namespace platform::block_design {

/// What became of an IP of the hand-off.
struct ImportedPart {
  std::string name;
  std::string vlnv;
  Kind kind = Kind::stub;
  std::string why;  ///< of a stub: what is missing
  // Of RTL:
  std::string target;            ///< what CMake builds: "filter_0"
  handoff::RtlSources rtl = {};  ///< where it is
};

/// A design made of a hand-off.
struct ImportedDesign {
  std::string text;                 ///< design.yaml
  std::vector<ImportedPart> parts;  ///< in the order of the hand-off
  std::vector<std::string> notes;   ///< what the user should know
};

/// Writes the hand-off as a design. An IP that is not on the shelf runs as RTL where `rtl` finds
/// some; without, or built in a way that is not modelled, it becomes a stub. Throws vp::InputError
/// for a device that is not known.
ImportedDesign import_design(const handoff::Handoff& handoff,
                             const handoff::RtlFinder& rtl = handoff::RtlFinder({}));

/// IMPORT.md: what was found in the hand-off, what is in the place of what, and what is missing.
/// `problem`: why the design cannot be built as it is; "" if it can.
std::string import_report(const handoff::Handoff& handoff, const ImportedDesign& design,
                          const std::string& problem);

/// The devices of the PL that the PS sees, as a device tree for Linux.
std::string device_tree(const handoff::Handoff& handoff);

/// registers.json: of each part that the PS sees the registers and fields that the hand-off names,
/// for register maps in notebooks.
std::string register_names(const handoff::Handoff& handoff);

/// What the vendor's tools make of the drivers of a design's own IP.
struct DriverFiles {
  std::vector<std::pair<std::string, std::string>> files;  ///< "filter_v1_0/filter.h", text
  std::string names;  ///< lines for xparameters.h: numbers and addresses of the instances
};

/// The drivers whose IP the design has, one of each name, with the tables of their instances.
/// Names that `xparameters` has already are not written again.
DriverFiles driver_files(const handoff::Handoff& handoff,
                         const std::vector<handoff::OwnDriver>& drivers,
                         const std::string& xparameters);

/// Whether programs of these texts are written for the flow with a system device tree, Vitis from
/// 2023.2 on, where `SDT` is defined: they use names that `xparameters` has behind `SDT` alone, and
/// none that the other flow has alone.
bool is_for_device_tree(const std::vector<std::string>& programs, const std::string& xparameters);

/// CMakeLists.txt of an imported design: its RTL, and its PS program of `sources`, as CMake finds
/// them from the folder, with what `drivers/` has. None: of what lies in its folder `software`.
/// `is_sdt`: they are for the flow with a system device tree.
std::string import_cmake(const std::string& name, const ImportedDesign& design,
                         const std::vector<std::string>& sources, bool is_sdt);

}  // namespace platform::block_design

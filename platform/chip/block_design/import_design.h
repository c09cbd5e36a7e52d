#pragma once

#include <string>
#include <vector>

#include <chip/block_design/shelf.h>
#include <chip/handoff/handoff.h>

namespace platform::block_design {

/// What became of an IP of the hand-off.
struct ImportedPart {
  std::string name;
  std::string vlnv;
  Kind kind = Kind::stub;
  std::string why;  ///< of a stub: what is missing
};

/// A design made of a hand-off.
struct ImportedDesign {
  std::string text;                 ///< design.yaml
  std::vector<ImportedPart> parts;  ///< in the order of the hand-off
  std::vector<std::string> notes;   ///< what the user should know
};

/// Writes the hand-off as a design. An IP that is not on the shelf, or is built in a way that is
/// not modelled, becomes a stub. Throws vp::InputError for a device that is not known.
ImportedDesign import_design(const handoff::Handoff& handoff);

}  // namespace platform::block_design

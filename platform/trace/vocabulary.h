#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace platform::trace {

/// The words by which a design's signals are known: paths by role, as a trace has them. What the
/// chip has in every design (`ps.…`) is known anyway.
struct Vocabulary {
  /// Rises when software starts the logic on a frame.
  std::string start;

  /// The register in which the logic hands over words, and how words count: the name of a column,
  /// and whether a word belongs there. 0 is no word.
  std::string word;
  struct WordKind {
    std::string column;
    bool (*counts)(std::uint64_t word);
  };
  std::vector<WordKind> word_kinds;
  /// What a word says, for GTKWave. `widths`: of `fields`, signals that tell by their width how a
  /// word is divided; 0 for one that the trace lacks.
  std::string (*meaning)(std::uint64_t word, const std::vector<unsigned>& widths) = nullptr;
  std::vector<std::string> fields;

  /// How full a buffer is, the signal that tells its depth, and the depth if the trace lacks that.
  struct Buffer {
    std::string count, depth;
    std::uint64_t usual_depth;
  };
  std::vector<Buffer> buffers;

  /// Counts what was lost; `name` as in `counts` of result.json.
  struct Loss {
    std::string name, path;
  };
  std::vector<Loss> losses;

  /// An interrupt line to the PS, its usual number, and its name and colour for GTKWave.
  struct Interrupt {
    std::string line;
    std::uint64_t id;
    std::string text, colour;
  };
  std::vector<Interrupt> interrupts;
  /// The vector that these lines make, IRQ_F2P: it tells their numbers in this trace.
  std::string irq_f2p;

  /// Signals that stand still where `fidelity`, a key of the configuration, is tlm: frames pass as
  /// a whole there.
  struct Unplayed {
    std::string fidelity, signals;
  };
  std::vector<Unplayed> unplayed;

  /// Functions of the software between which its stages lie. Without `evaluation` there are no
  /// stages.
  struct Functions {
    std::string upload, capture, receive, evaluation;
    std::vector<std::string> search;  ///< what follows the evaluation
    std::string last;                 ///< what ends a frame
    std::string last_column;          ///< its column in the table
  };
  Functions functions;

  /// Signals of GTKWave's page of the system, by title.
  struct Group {
    std::string title;
    std::vector<std::string> paths;
  };
  std::vector<Group> groups;

  /// Signals whose values have names, and the translate file that says them: `words` below, or one
  /// of `files`.
  std::map<std::string, std::string> translated;
  std::map<std::string, std::string> files;
  /// The translate file of words, made of those that occur.
  static constexpr const char* words = "feature.flt";
};

}  // namespace platform::trace

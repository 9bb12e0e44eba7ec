// Errors as values: what depends on the input never throws.
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace meshgraft {

/// A place in a file of the user.
struct Place {
  std::string file;
  std::uint64_t line = 0;  // 1-based; 0 = the whole file
};

/// Stable names of what can go wrong; docs/errors.md has one entry each.
enum class ErrorCode {
  kUsage,                // contradictory or impossible options
  kCannotRead,           // missing file, directory, no permission
  kCannotWrite,          // output cannot be created, disk full
  kEmptyFile,            // nothing in it
  kUnknownFormat,        // not a format we read
  kMalformed,            // a record that cannot be understood
  kTruncated,            // the file ends inside a record
  kBadNumber,            // not a number, infinite, decimal comma, overflow
  kUnknownNode,          // an element refers to a node that is not defined
  kDuplicateLabel,       // one label, two different things
  kSeveralModels,        // more than one FE model in one file
  kDegenerateFace,       // a face without area in the zone
  kDuplicateFace,        // two faces on the same nodes in the zone
  kUnitsDiffer,          // dataset 164 of the inputs disagrees
  kCoordinateSystem,     // nodes given in systems that differ
  kScaleMismatch,        // meshes so different in size that no grading is sensible
  kNoFaces,              // no triangles to merge
  kPartsApart,           // a part meets nothing
  kOverlap,              // faces lie on each other where that is not wanted or has no clear border
  kNotSeparated,         // a tool does not cut all the way, or its sides cannot be told
  kUnsupportedElement,   // parts meet at elements that cannot be remeshed
  kJunctionNotResolved,  // the junction could not be made conforming
  kContourNotFilled,     // no triangulation of a contour follows the surface around it
  kPromiseBroken,        // the result failed its own check
  kLabelOverflow,        // no room for new labels
  kCannotHold,           // the target format cannot hold what the model has
};

/// `unknown-node` for kUnknownNode, and so on: the name printed and documented.
[[nodiscard]] const char* name(ErrorCode code);

struct Error {
  ErrorCode code = ErrorCode::kMalformed;
  std::string what;  // what is wrong, with the value that was found
  std::string hint;  // what the user can do next; may be empty
  Place place;
};

/// `file:line: error [name]: what` and, on a second line, the hint.
[[nodiscard]] std::string to_string(const Error& error);

template <class T>
using Result = tl::expected<T, Error>;
using Failure = tl::unexpected<Error>;

[[nodiscard]] inline Failure failure(ErrorCode code, std::string what, std::string hint = {}, Place place = {}) {
  return Failure(Error{code, std::move(what), std::move(hint), std::move(place)});
}

/// Something the user should know that does not stop the work.
struct Warning {
  std::string name;  // stable, as for errors
  std::string what;
  Place place;
};

/// `file:line: warning [name]: what`.
[[nodiscard]] std::string to_string(const Warning& warning);

}  // namespace meshgraft

#include "meshgraft/result.hpp"

namespace meshgraft {

const char* name(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return "usage";
    case ErrorCode::kCannotRead:
      return "cannot-read";
    case ErrorCode::kCannotWrite:
      return "cannot-write";
    case ErrorCode::kEmptyFile:
      return "empty-file";
    case ErrorCode::kUnknownFormat:
      return "unknown-format";
    case ErrorCode::kMalformed:
      return "malformed";
    case ErrorCode::kTruncated:
      return "truncated";
    case ErrorCode::kBadNumber:
      return "bad-number";
    case ErrorCode::kUnknownNode:
      return "unknown-node";
    case ErrorCode::kDuplicateLabel:
      return "duplicate-label";
    case ErrorCode::kSeveralModels:
      return "several-models";
    case ErrorCode::kDegenerateFace:
      return "degenerate-face";
    case ErrorCode::kDuplicateFace:
      return "duplicate-face";
    case ErrorCode::kUnitsDiffer:
      return "units-differ";
    case ErrorCode::kCoordinateSystem:
      return "coordinate-system";
    case ErrorCode::kScaleMismatch:
      return "scale-mismatch";
    case ErrorCode::kNoFaces:
      return "no-faces";
    case ErrorCode::kPartsApart:
      return "parts-apart";
    case ErrorCode::kOverlap:
      return "overlap";
    case ErrorCode::kNotSeparated:
      return "not-separated";
    case ErrorCode::kUnsupportedElement:
      return "unsupported-element";
    case ErrorCode::kJunctionNotResolved:
      return "junction-not-resolved";
    case ErrorCode::kContourNotFilled:
      return "contour-not-filled";
    case ErrorCode::kPromiseBroken:
      return "promise-broken";
    case ErrorCode::kLabelOverflow:
      return "label-overflow";
    case ErrorCode::kCannotHold:
      return "cannot-hold";
  }
  return "unknown";
}

namespace {

std::string prefix(const Place& place) {
  if (place.file.empty()) return {};
  return place.line == 0 ? place.file + ": " : place.file + ":" + std::to_string(place.line) + ": ";
}

}  // namespace

std::string to_string(const Error& error) {
  std::string text = prefix(error.place) + "error [" + name(error.code) + "]: " + error.what;
  if (!error.hint.empty()) text += "\n  hint: " + error.hint;
  return text;
}

std::string to_string(const Warning& warning) {
  return prefix(warning.place) + "warning [" + warning.name + "]: " + warning.what;
}

}  // namespace meshgraft

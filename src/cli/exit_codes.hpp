// What the program tells the shell.
#pragma once

#include "meshgraft/result.hpp"

namespace meshgraft::cli {

enum ExitCode : int {
  kDone = 0,
  kPromiseNotMet = 1,   // nothing written unless --allow-poor; `check`: the mesh is not sound
  kWrongUsage = 2,      // of the command line
  kInputInvalid = 3,    // cannot be read, or cannot be merged as it is
  kPartsDoNotMeet = 4,  // nothing written unless --allow-apart
  kOutputFailed = 5,    // cannot be written
};

/// The table of docs/errors.md.
[[nodiscard]] constexpr ExitCode exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return kWrongUsage;
    case ErrorCode::kCannotWrite:
    case ErrorCode::kCannotHold:
      return kOutputFailed;
    case ErrorCode::kPartsApart:
      return kPartsDoNotMeet;
    case ErrorCode::kJunctionNotResolved:
    case ErrorCode::kContourNotFilled:
    case ErrorCode::kPromiseBroken:
      return kPromiseNotMet;
    case ErrorCode::kCannotRead:
    case ErrorCode::kEmptyFile:
    case ErrorCode::kUnknownFormat:
    case ErrorCode::kMalformed:
    case ErrorCode::kTruncated:
    case ErrorCode::kBadNumber:
    case ErrorCode::kUnknownNode:
    case ErrorCode::kDuplicateLabel:
    case ErrorCode::kSeveralModels:
    case ErrorCode::kDegenerateFace:
    case ErrorCode::kDuplicateFace:
    case ErrorCode::kUnitsDiffer:
    case ErrorCode::kCoordinateSystem:
    case ErrorCode::kScaleMismatch:
    case ErrorCode::kNoFaces:
    case ErrorCode::kOverlap:
    case ErrorCode::kNotSeparated:
    case ErrorCode::kUnsupportedElement:
    case ErrorCode::kLabelOverflow:
      break;
  }
  return kInputInvalid;
}

}  // namespace meshgraft::cli

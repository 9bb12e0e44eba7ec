#include "io/unv_types.hpp"

#include <algorithm>
#include <array>

namespace meshgraft::unv {
namespace {

struct Type {
  std::int16_t id;
  std::int8_t nodes;  // 0: any number
  Shape shape;
};

// Ascending by id. Several rows where writers use one id for several shapes.
constexpr Type kTypes[] = {
    {11, 2, Shape::kLine},     {21, 2, Shape::kLine},      {22, 2, Shape::kLine},     {22, 3, Shape::kLine3},
    {23, 2, Shape::kLine},     {23, 3, Shape::kLine3},     {24, 3, Shape::kLine3},    {25, 2, Shape::kLine},
    {25, 3, Shape::kLine3},    {31, 2, Shape::kLine},      {32, 3, Shape::kLine3},    {32, 2, Shape::kLine},
    {41, 3, Shape::kTriangle}, {42, 6, Shape::kTriangle6}, {42, 7, Shape::kOther},    {43, 9, Shape::kOther},
    {44, 4, Shape::kQuad},     {45, 8, Shape::kQuad8},     {45, 9, Shape::kQuad8},    {46, 12, Shape::kQuad8},
    {51, 3, Shape::kTriangle}, {52, 6, Shape::kTriangle6}, {53, 9, Shape::kOther},    {54, 4, Shape::kQuad},
    {55, 8, Shape::kQuad8},    {56, 12, Shape::kQuad8},    {61, 3, Shape::kTriangle}, {62, 6, Shape::kTriangle6},
    {63, 9, Shape::kOther},    {64, 4, Shape::kQuad},      {65, 8, Shape::kQuad8},    {66, 12, Shape::kQuad8},
    {71, 4, Shape::kQuad},     {72, 6, Shape::kTriangle6}, {73, 9, Shape::kOther},    {74, 3, Shape::kTriangle},
    {75, 8, Shape::kQuad8},    {76, 12, Shape::kQuad8},    {81, 3, Shape::kTriangle}, {82, 6, Shape::kTriangle6},
    {84, 4, Shape::kQuad},     {85, 8, Shape::kQuad8},     {91, 3, Shape::kTriangle}, {92, 6, Shape::kTriangle6},
    {92, 7, Shape::kOther},    {93, 9, Shape::kOther},     {94, 4, Shape::kQuad},     {95, 8, Shape::kQuad8},
    {95, 9, Shape::kQuad8},    {96, 12, Shape::kQuad8},    {101, 6, Shape::kSolid},   {102, 12, Shape::kSolid},
    {103, 18, Shape::kSolid},  {104, 8, Shape::kSolid},    {105, 16, Shape::kSolid},  {105, 20, Shape::kSolid},
    {106, 24, Shape::kSolid},  {111, 4, Shape::kSolid},    {112, 6, Shape::kSolid},   {113, 15, Shape::kSolid},
    {114, 13, Shape::kSolid},  {114, 24, Shape::kSolid},   {115, 8, Shape::kSolid},   {116, 20, Shape::kSolid},
    {117, 32, Shape::kSolid},  {118, 10, Shape::kSolid},   {119, 5, Shape::kSolid},   {121, 2, Shape::kOther},
    {122, 0, Shape::kOther},   {136, 2, Shape::kOther},    {137, 2, Shape::kOther},   {138, 1, Shape::kPoint},
    {139, 1, Shape::kPoint},   {141, 2, Shape::kOther},    {142, 1, Shape::kPoint},   {151, 2, Shape::kOther},
    {152, 1, Shape::kPoint},   {161, 1, Shape::kPoint},    {171, 2, Shape::kLine},    {172, 3, Shape::kLine3},
    {181, 0, Shape::kOther},   {191, 2, Shape::kLine},     {192, 2, Shape::kLine},    {193, 2, Shape::kLine},
    {194, 2, Shape::kLine},    {195, 2, Shape::kLine},     {196, 2, Shape::kLine},    {201, 0, Shape::kOther},
    {202, 0, Shape::kOther},   {203, 0, Shape::kOther},    {204, 0, Shape::kOther},   {208, 0, Shape::kOther},
    {212, 0, Shape::kOther},   {213, 0, Shape::kOther},    {221, 0, Shape::kOther},   {222, 0, Shape::kOther},
    {231, 0, Shape::kOther},   {232, 0, Shape::kOther},    {300, 9, Shape::kQuad8},   {312, 5, Shape::kSolid},
};
static_assert(std::ranges::is_sorted(kTypes, {}, &Type::id));

auto rows_of(std::int64_t id) {
  return std::ranges::equal_range(kTypes, id, {}, [](const Type& t) { return std::int64_t{t.id}; });
}

const Type* type_of(std::int64_t id, std::int64_t n) {
  for (const Type& t : rows_of(id))
    if (t.nodes == 0 || t.nodes == n) return &t;
  return nullptr;
}

struct Graphical {
  std::int8_t code;
  std::int16_t id;
};
constexpr Graphical kGraphical[] = {
    {1, 21},   {2, 91},   {3, 92},   {4, 93},   {5, 94},   {6, 95},   {7, 96},   {8, 101},  {9, 102},  {10, 103},
    {11, 104}, {12, 105}, {13, 106}, {14, 111}, {15, 118}, {16, 112}, {17, 113}, {18, 114}, {19, 115}, {20, 116},
    {21, 117}, {29, 136}, {30, 138}, {31, 141}, {32, 142}, {33, 161}, {34, 121}, {35, 24},
};

}  // namespace

Shape shape_of(std::int64_t id, std::int64_t n) {
  const Type* type = type_of(id, n);
  return type != nullptr ? type->shape : Shape::kOther;
}

bool is_known_type(std::int64_t id, std::int64_t n) { return type_of(id, n) != nullptr; }

bool is_odd_count(std::int64_t id, std::int64_t n) {
  return n == 0 || (!rows_of(id).empty() && type_of(id, n) == nullptr);
}

std::int64_t descriptor_of_graphical(std::int64_t code) {
  const auto* row = std::ranges::find(kGraphical, code, &Graphical::code);
  return row != std::end(kGraphical) ? row->id : 0;
}

std::int64_t graphical_of_descriptor(std::int64_t id) {
  const auto* row = std::ranges::find(kGraphical, id, &Graphical::id);
  return row != std::end(kGraphical) ? row->code : 0;
}

std::int64_t default_descriptor(Shape shape, std::size_t n) {
  switch (shape) {
    case Shape::kPoint:
      return 161;
    case Shape::kLine:
      return 21;
    case Shape::kLine3:
      return 24;
    case Shape::kTriangle:
      return 91;
    case Shape::kTriangle6:
      return 92;
    case Shape::kQuad:
      return 94;
    case Shape::kQuad8:
      return n == 12 ? 96 : n == 9 ? 300 : 95;
    case Shape::kSolid:
      for (const std::int64_t id : {111, 118, 112, 113, 115, 116, 312, 114, 117})
        if (is_known_type(id, static_cast<std::int64_t>(n))) return id;
      return 122;
    case Shape::kOther:
      return 122;
  }
  return 122;
}

}  // namespace meshgraft::unv

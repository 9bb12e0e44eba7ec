// Reads damaged universal files. With arguments: replays files. Without: a fixed number of mutations
// of a built-in corpus, from a fixed seed. Built with -fsanitize=fuzzer, only the first function is used.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "meshgraft/unv.hpp"

/// Whatever the bytes are: no crash, and what can be read is written back as it was.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto model = meshgraft::read_unv_text(text, "fuzz.unv", {.threads = 1, .unclosed = true});
  if (!model) return 0;
  const auto written = meshgraft::unv_text(*model);
  if (!written || *written != text) std::abort();
  const std::size_t m = model->n_elements();
  if (model->node_label.size() != model->n_nodes() || model->first_node.size() != m + 1) std::abort();
  for (const meshgraft::NodeId v : model->nodes)
    if (v.valid() && v.value >= model->n_nodes()) std::abort();
  if (m > 0) (void)place_of(*model, meshgraft::ElementId(m - 1));
  return 0;
}

#ifndef MESHGRAFT_LIBFUZZER
namespace {

constexpr std::string_view kCorpus[] = {
    R"(    -1
   164
         1Meter (newton)               2
   1.0000000000000000D+00   1.0000000000000000D+00   1.0000000000000000D+00
   2.7314999999999998D+02
    -1
    -1
  2411
         1         1         1        11
   0.0000000000000000D+00   0.0000000000000000D+00   3.3333333333333331D-01
         2         1         1        11
   1.0000000000000000D+00   0.0000000000000000D+00   3.3333333333333331D-01
         5         1         1        11
   1.0000000000000000D+00   1.0000000000000000D+00   3.3333333333333331D-01
    -1
    -1
  2412
         1        91         1         1         7         3
         1         2         5
         2        21         1         1         7         2
         0         1         1
         1         2
    -1
    -1
  2467
         1         0         0         0         0         0         0         3
SIDE
         8         1         0         0         7         2         0         0
         7         5         0         0
         2         0         0         0         0         0         0         0
NONE
    -1
)",
    R"(    -1
   781
         1         0         0        11
   .5000000069999999D-01  -1.0000000000000000D+00   1.0000000000000000-001
    -1
    -1
   780
         7        21         1         1         1         1         7         2
         0         1         1         1         1
         1         1
    -1
    -1
   752
         1         0         0         0         0         2
AIR 
         8         7         7         1
    -1
    -1
  2414
 -WARNING-
        -1
    -1
)",
    R"(-1
2411
1 1 1 11
1.5 2.5 3.5
-1
-1
15
2 0 0 8 1. 2. 3.
-1
-1
71
1 33 0 1 1 7 1
1
-1
)",
    "    -1\n    58b     1     2           1           9     0     0           0           0\nid\n12\n    -1\n    -1\n",
};

/// Pieces that damage tends to be made of.
constexpr std::string_view kPieces[] = {"    -1\n", "  2411\n", "  2467\n", "         8",  "-",         " ",
                                        "\r",       "\n",       "\t",       "99999999999", "D+999",     "****",
                                        "NaN",      ",",        "58b",      "\x1a",        "         0"};

std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  const std::size_t changes = 1 + below(4);
  for (std::size_t k = 0; k < changes; ++k) {
    const std::size_t at = below(text.size() + 1), n = below(60);
    switch (below(6)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.erase(at, n);
        break;
      case 2:
        text.insert(at, kPieces[below(std::size(kPieces))]);
        break;
      case 3:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 4:
        if (at < text.size()) text[at] = static_cast<char>('0' + below(10));
        break;
      default: {
        const std::string copy = text.substr(at, n);
        text.insert(below(text.size() + 1), copy);
      }
    }
  }
  return text;
}

void run(const std::string& text) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

int main(int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    std::ifstream in(argv[k], std::ios::binary);
    run({std::istreambuf_iterator<char>(in), {}});
  }
  if (argc > 1) return 0;
  constexpr int kRounds = 20000;
  std::mt19937 random(1);
  for (const std::string_view text : kCorpus) run(std::string(text));
  for (int k = 0; k < kRounds; ++k) {
    std::string text(kCorpus[random() % std::size(kCorpus)]);
    if (random() % 8 == 0) text += kCorpus[random() % std::size(kCorpus)];
    run(mutated(std::move(text), random));
  }
  std::printf("%d mutated files\n", kRounds);
  return 0;
}
#endif

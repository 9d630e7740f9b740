#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/seed.h"

// Where libFuzzer is not there: runs the target on every seed, on every tenth of each seed, and on a fixed number of
// mutations of each. The same bytes in every run.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr int mutations_per_seed = 2000;

class ByteMutator {
 public:
  explicit ByteMutator(std::uint64_t seed) : random_(seed) {}

  std::string mutated(std::string text, const std::vector<std::string>& seeds) {
    for (std::size_t n = 1 + below(4); n > 0 && !text.empty(); --n) {
      const std::size_t at = below(text.size());
      const std::size_t length = std::min(text.size() - at, 1 + below(40));
      switch (below(8)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
          break;
        case 2:
          text.erase(at, length);
          break;
        case 3:
          text.insert(at, std::string(text, at, length));
          break;
        case 4:
          text.insert(at, words[below(std::size(words))]);
          break;
        case 5:
          text.resize(at);
          break;
        case 6:
          text.insert(at, length, static_cast<char>(below(256)));
          break;
        default: {  // a piece of another seed
          const std::string& other = seeds[below(seeds.size())];
          if (!other.empty()) {
            const std::size_t from = below(other.size());
            text.replace(at, length, other.substr(from, 1 + below(200)));
          }
        }
      }
    }
    return text;
  }

 private:
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random_.below(limit)); }
  static constexpr const char* words[] = {"nan", "-inf", "1e999", "-1", "4294967295", "18446744073709551615",
                                          "0",   "\n",   "\r\n",  "\t", "END",        "\"",
                                          "}",   "{"};
  strataflow::RandomStream random_;
};

void run(const std::string& text) {
  const std::vector<std::uint8_t> exact(text.begin(), text.end());  // no spare byte behind: over-reads are seen
  LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

}  // namespace

int main(int argument_count, char** arguments) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argument_count; ++i)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[i]))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    std::fprintf(stderr, "no seeds: name the folder of a seed corpus\n");
    return 2;
  }
  std::vector<std::string> seeds;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  run("");
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    run(seeds[s]);
    for (std::size_t tenth = 1; tenth < 10; ++tenth) run(seeds[s].substr(0, seeds[s].size() * tenth / 10));
    ByteMutator mutator(strataflow::mix64(s + 1));
    for (int n = 0; n < mutations_per_seed; ++n) run(mutator.mutated(seeds[s], seeds));
  }
  std::printf("%zu seeds, %d mutations each\n", seeds.size(), mutations_per_seed);
  return 0;
}

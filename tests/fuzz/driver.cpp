// Changes files of a corpus at random and tries them: fuzzing with any compiler. An input is made
// of the seed and its number and of nothing else, so that one that was found is found again.
//
//   quadrille_fuzz_KIND CORPUS [--seed N] [--inputs N] [--first N] [--write FILE]
//
// `--first N --inputs 1` repeats input N, and --write keeps it as a file.

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <sys/time.h>
#include <unistd.h>
#include <vector>

#include <quadrille/random.hpp>

#include "fuzz/input.hpp"

namespace quadrille::fuzz {

namespace {

/// Of processor time, for one input: a run without end is a finding, too.
constexpr int mostSeconds = 20;

volatile std::sig_atomic_t current = 0;

void sayWhich(int signal) {
    std::array<char, 80> text{};
    char* end = text.data();
    const auto put = [&](std::string_view part) { end = std::copy(part.begin(), part.end(), end); };
    put("signal ");
    end = std::to_chars(end, text.data() + text.size(), signal).ptr;
    put(" in input ");
    end = std::to_chars(end, text.data() + text.size(), static_cast<long>(current)).ptr;
    put("\n");
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), end - text.data());
    std::signal(signal, SIG_DFL);
    std::raise(signal == SIGPROF ? SIGABRT : signal);
}

template <class T>
std::string bytesOf(T value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
}

/// Numbers at the borders of what can be, as they lie in a file.
std::vector<std::string> specialNumbers() {
    std::vector<std::string> result;
    for (const std::uint32_t value : {0u, 1u, 2u, 3u, 255u, 0x7ffffffeu, 0x7fffffffu, 0x80000000u,
                                      0x80000001u, 0xfffffffeu, 0xffffffffu}) {
        result.push_back(bytesOf(static_cast<std::uint8_t>(value)));
        result.push_back(bytesOf(value));
        result.push_back(bytesOf(std::uint64_t(value)));
        result.push_back(bytesOf(std::uint64_t(value) << 32));
    }
    const auto floating = [&]<class Real>(Real) {
        using Limits = std::numeric_limits<Real>;
        for (const Real value : {Real(0), Real(1), Real(0.5), Limits::min(), Limits::denorm_min(),
                                 Limits::max(), Limits::epsilon(), Limits::infinity(),
                                 Limits::quiet_NaN(), Real(1e-9), Real(1e9), Real(1e30)}) {
            result.push_back(bytesOf(value));
            result.push_back(bytesOf(-value));
        }
    };
    floating(0.0);
    floating(0.0f);
    return result;
}

class Mutator {
  public:
    Mutator(const std::vector<std::string>& corpus, std::uint64_t seed, std::uint64_t number)
        : corpus_(corpus), random_(seed * 0x9e3779b97f4a7c15u + number) {}

    std::string input() {
        std::string text = any();
        for (std::size_t rounds = pick(1, 3); rounds > 0; --rounds) change(text);
        return text;
    }

  private:
    std::size_t pick(std::size_t low, std::size_t high) {
        return static_cast<std::size_t>(random_.integer(std::int64_t(low), std::int64_t(high)));
    }
    const std::string& any() { return corpus_[pick(0, corpus_.size() - 1)]; }

    void change(std::string& text) {
        static const std::vector<std::string> numbers = specialNumbers();
        const std::size_t at = pick(0, text.size());
        const std::size_t length = std::min(pick(0, 32), text.size() - at);
        switch (pick(0, 11)) {
            case 0:
                if (at < text.size()) text[at] = static_cast<char>(text[at] ^ 1 << pick(0, 7));
                break;
            case 1:
                if (at < text.size()) text[at] = static_cast<char>(pick(0, 255));
                break;
            case 2:
                text.erase(at, length);
                break;
            case 3:
                text.insert(pick(0, text.size()), text.substr(at, length));
                break;
            case 4: {  // one part over another
                const std::size_t to = pick(0, text.size() - length);
                text.replace(to, length, std::string(text, at, length));
                break;
            }
            case 5: {
                const std::string& other = any();
                text.replace(at, length, other, pick(0, other.size()), length);
                break;
            }
            default: {  // most faults lie in numbers that could have been written
                const std::string& number = numbers[pick(0, numbers.size() - 1)];
                text.replace(at, std::min(number.size(), text.size() - at), number);
                break;
            }
        }
    }

    const std::vector<std::string>& corpus_;
    Random random_;
};

std::vector<std::string> read(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<std::string> result;
    for (const auto& file : files) {
        std::ifstream in(file, std::ios::binary);
        result.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return result;
}

struct Plan {
    std::filesystem::path corpus, write;
    std::uint64_t seed = 1, first = 0, inputs = 1000;
};

Plan planOf(int argc, char** argv) {
    Plan plan;
    if (argc < 2 || argc % 2 != 0) throw std::invalid_argument("usage: see tests/fuzz/driver.cpp");
    plan.corpus = argv[1];
    for (int i = 2; i + 1 < argc; i += 2) {
        const std::string option = argv[i];
        if (option == "--write") {
            plan.write = argv[i + 1];
        } else if (option == "--seed") {
            plan.seed = std::stoull(argv[i + 1]);
        } else if (option == "--first") {
            plan.first = std::stoull(argv[i + 1]);
        } else if (option == "--inputs") {
            plan.inputs = std::stoull(argv[i + 1]);
        } else {
            throw std::invalid_argument("unknown option " + option);
        }
    }
    return plan;
}

int run(const Plan& plan) {
    const std::vector<std::string> corpus = read(plan.corpus);
    if (corpus.empty()) throw std::invalid_argument(plan.corpus.string() + " is empty");
    std::cout << "seed " << plan.seed << ", " << plan.inputs << " inputs from number " << plan.first
              << std::endl;
    for (const std::string& input : corpus) {
        if (!tryInput(input)) throw Finding("a file of the corpus is refused");
    }
    std::uint64_t taken = 0;
    for (std::uint64_t i = plan.first; i < plan.first + plan.inputs; ++i) {
        current = static_cast<std::sig_atomic_t>(i);
        const std::string input = Mutator(corpus, plan.seed, i).input();
        if (!plan.write.empty()) std::ofstream(plan.write, std::ios::binary) << input;
        const itimerval limit{{0, 0}, {mostSeconds, 0}};
        setitimer(ITIMER_PROF, &limit, nullptr);
        try {
            taken += tryInput(input);
        } catch (const std::exception& error) {
            std::cerr << "input " << i << ": " << error.what() << '\n';
            return 1;
        }
    }
    std::cout << taken << " taken, " << plan.inputs - taken << " refused\n";
    return 0;
}

}  // namespace

}  // namespace quadrille::fuzz

int main(int argc, char** argv) {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPROF}) {
        std::signal(signal, quadrille::fuzz::sayWhich);
    }
    try {
        return quadrille::fuzz::run(quadrille::fuzz::planOf(argc, argv));
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
}

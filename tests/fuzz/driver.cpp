// Changes files of a corpus at random and tries them: fuzzing with any compiler. An input is made
// of the seed and its number and of nothing else, so that one that was found is found again.
//
//   quadrille_fuzz_KIND CORPUS [--dict FILE] [--seed N] [--inputs N | --seconds N] [--first N]
//                       [--write FILE]
//
// `--first N --inputs 1` repeats input N, and --write keeps it as a file. A dictionary is one of
// libFuzzer's, for inputs that are text; without one, changes put in numbers as they lie in a
// binary file.

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <stdexcept>
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

/// What stands between the quotes of an entry, with \\, \" and \xAB for other characters.
std::string unescaped(std::string_view entry) {
    std::string result;
    for (std::size_t i = 0; i < entry.size(); ++i) {
        if (entry[i] != '\\') {
            result += entry[i];
        } else if (++i < entry.size() && entry[i] != 'x') {
            result += entry[i];
        } else {
            unsigned value = 0;
            const std::string_view digits = entry.substr(std::min(i + 1, entry.size()), 2);
            const char* const end = digits.data() + digits.size();
            if (digits.size() != 2 || std::from_chars(digits.data(), end, value, 16).ptr != end) {
                throw std::invalid_argument("not an entry: " + std::string(entry));
            }
            result += static_cast<char>(value);
            i += 2;
        }
    }
    return result;
}

std::vector<std::string> readDictionary(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> result;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line.front() == '#') continue;
        if (line.size() < 3 || line.front() != '"' || line.back() != '"') {
            throw std::invalid_argument("not an entry: " + line);
        }
        result.push_back(unescaped(std::string_view(line).substr(1, line.size() - 2)));
    }
    if (result.empty()) throw std::invalid_argument(file.string() + " has no entries");
    return result;
}

struct Material {
    std::vector<std::string> corpus;
    std::vector<std::string> pieces;  ///< that changes put in
    bool text = false;
};

class Mutator {
  public:
    Mutator(const Material& material, std::uint64_t seed, std::uint64_t number)
        : material_(material), random_(seed * 0x9e3779b97f4a7c15u + number) {}

    std::string input() {
        std::string text = any();
        for (std::size_t rounds = pick(1, 3); rounds > 0; --rounds) change(text);
        return text;
    }

  private:
    std::size_t pick(std::size_t low, std::size_t high) {
        return static_cast<std::size_t>(random_.integer(std::int64_t(low), std::int64_t(high)));
    }
    const std::string& any() { return any(material_.corpus); }
    const std::string& any(const std::vector<std::string>& list) {
        return list[pick(0, list.size() - 1)];
    }

    void change(std::string& text) {
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
            case 6:
                if (material_.text) return pick(0, 1) == 0 ? insert(text, at) : repeat(text, at);
                [[fallthrough]];
            default:  // most faults lie in what could have been written
                material_.text ? replaceWord(text, at) : replaceNumber(text, at);
                break;
        }
    }

    void replaceNumber(std::string& text, std::size_t at) {
        const std::string& number = any(material_.pieces);
        text.replace(at, std::min(number.size(), text.size() - at), number);
    }
    /// Mostly what begins like a number by another, or too few inputs would be taken.
    void replaceWord(std::string& text, std::size_t at) {
        static constexpr std::string_view ends = " ,=[]{}\"\r\n";
        if (at > 0) at = text.find_last_of(ends, at - 1) + 1;
        const std::size_t length = std::min(text.find_first_of(ends, at), text.size()) - at;
        const auto isNumber = [](std::string_view word) {
            return !word.empty() &&
                   std::string_view("-0123456789in").find(word.front()) != word.npos;
        };
        const bool number = isNumber(std::string_view(text).substr(at, length));
        const std::string* piece = &any(material_.pieces);
        for (int i = 0; i < 20 && isNumber(*piece) != number; ++i) piece = &any(material_.pieces);
        text.replace(at, length, *piece);
    }
    void insert(std::string& text, std::size_t at) { text.insert(at, any(material_.pieces)); }
    void repeat(std::string& text, std::size_t at) {
        const std::string& piece = any(material_.pieces);
        std::string many;
        for (std::size_t i = pick(0, 400); i > 0; --i) many += piece;
        text.insert(at, many);
    }

    const Material& material_;
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
    std::filesystem::path corpus, dictionary, write;
    std::uint64_t seed = 1, first = 0, inputs = 1000;
    std::uint64_t seconds = 0;  ///< instead of a number of inputs
};

Plan planOf(int argc, char** argv) {
    Plan plan;
    if (argc < 2 || argc % 2 != 0) throw std::invalid_argument("usage: see tests/fuzz/driver.cpp");
    plan.corpus = argv[1];
    for (int i = 2; i + 1 < argc; i += 2) {
        const std::string option = argv[i];
        if (option == "--write") {
            plan.write = argv[i + 1];
        } else if (option == "--dict") {
            plan.dictionary = argv[i + 1];
        } else if (option == "--seconds") {
            plan.seconds = std::stoull(argv[i + 1]);
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

Material materialOf(const Plan& plan) {
    const bool text = !plan.dictionary.empty();
    Material material{.corpus = read(plan.corpus),
                      .pieces = text ? readDictionary(plan.dictionary) : specialNumbers(),
                      .text = text};
    if (material.corpus.empty()) throw std::invalid_argument(plan.corpus.string() + " is empty");
    return material;
}

int run(const Plan& plan) {
    const Material material = materialOf(plan);
    std::cout << "seed " << plan.seed << ", inputs from number " << plan.first << std::endl;
    for (const std::string& input : material.corpus) {
        if (!tryInput(input)) throw Finding("a file of the corpus is refused");
    }
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::seconds(plan.seconds);
    std::uint64_t tried = 0, taken = 0;
    for (; plan.seconds > 0 ? Clock::now() < end : tried < plan.inputs; ++tried) {
        const std::uint64_t i = plan.first + tried;
        current = static_cast<std::sig_atomic_t>(i);
        const std::string input = Mutator(material, plan.seed, i).input();
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
    std::cout << tried << " inputs: " << taken << " taken, " << tried - taken << " refused\n";
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

#include "app/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/version.hpp>

#include "app/exit_code.hpp"
#include "app/one_of.hpp"
#include "app/option_list.hpp"
#include "app/scene_catalog.hpp"
#include "app/standard_streams.hpp"
#include "system/whole_file.hpp"

namespace quadrille::app {

namespace {

/// The options as they were typed, where that is not yet what the program needs.
struct RawOptions {
    std::string partitioner{name(PartitionerConfig(SemiStaticQuadtree{}))};
    std::string cellSize = "26,26";
    int maxDepth = 10;
    int maxPerCell = 20;
    std::string rebuild = "skin";
    std::string law, precision;
    std::string resolver{name(ResolverKind::Auto)};
    std::string cudaThread = "body";
    std::string generate;
    std::vector<std::string> compare;
    bool sceneGiven = false;
};

double parseNumber(std::string_view text, const char* option) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        throw UsageError(std::string(option) + ": '" + std::string(text) + "' is not a number");
    }
    return value;
}

Vec2 parseCellSize(std::string_view text) {
    const std::size_t comma = text.find(',');
    const double width = parseNumber(text.substr(0, comma), "--cell-size");
    const double height = comma == std::string_view::npos
                              ? width
                              : parseNumber(text.substr(comma + 1), "--cell-size");
    if (!(width > 0 && height > 0)) throw UsageError("--cell-size: must be positive");
    return {width, height};
}

decltype(SemiStaticQuadtree::rebuild) parseRebuild(std::string_view text) {
    if (text == "skin") return SemiStaticQuadtree::Skin{};
    if (text.starts_with("skin:")) {
        const double width = parseNumber(text.substr(5), "--rebuild");
        if (!(width > 0)) throw UsageError("--rebuild: the skin must be positive");
        return SemiStaticQuadtree::Skin{width};
    }
    if (text.starts_with("every:")) {
        const double frames = parseNumber(text.substr(6), "--rebuild");
        if (!(frames >= 1 && frames <= 1e9 && frames == std::floor(frames))) {
            throw UsageError("--rebuild: every:K takes a whole number from 1");
        }
        return SemiStaticQuadtree::EveryFrames{static_cast<int>(frames)};
    }
    const std::array<std::string, 2> policies = {"skin", "every"};
    throw UsageError("--rebuild: '" + std::string(text) +
                     "' is not known; valid: skin, skin:WIDTH, every:K" +
                     didYouMean(nearestNames(text.substr(0, text.find(':')), policies)));
}

/// CLI11 converts as strtoull does, which wraps -1, cuts what is too large and reads 010 as octal.
const CLI::Validator wholeNumber(
    [](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool octal = text.size() > 1 && text[0] == '0';
        if (error == std::errc() && end == text.data() + text.size() && !octal) return {};
        return "'" + text + "' is not a whole number from 0 to 2^64 - 1";
    },
    "");

/// After wholeNumber, which leaves one way to write it.
const CLI::Validator notZero(
    [](std::string& text) { return text == "0" ? std::string("'0' is not above 0") : ""; }, "");

/// CLI::PositiveNumber and CLI::Range let NaN pass, and print the largest double in full.
CLI::Validator finiteNumber(bool (*valid)(double), std::string range) {
    return CLI::Validator(
        [valid, range = std::move(range)](std::string& text) -> std::string {
            double value = 0;
            const auto [end, error] =
                std::from_chars(text.data(), text.data() + text.size(), value);
            const bool number = error == std::errc() && end == text.data() + text.size();
            if (number && std::isfinite(value) && valid(value)) return {};
            return "'" + text + "' is not a number " + range;
        },
        "");
}
const auto positiveNumber = [] {
    return finiteNumber([](double value) { return value > 0; }, "above 0");
};

/// Writes "1/60" as the number that it is.
const CLI::Validator fraction(
    [](std::string& text) -> std::string {
        const std::size_t slash = text.find('/');
        if (slash == std::string::npos) return {};
        double over = 0, under = 0;
        const char* const end = text.data() + text.size();
        const auto first = std::from_chars(text.data(), text.data() + slash, over);
        const auto second = std::from_chars(text.data() + slash + 1, end, under);
        const bool numbers = first.ec == std::errc() && first.ptr == text.data() + slash &&
                             second.ec == std::errc() && second.ptr == end;
        if (!numbers || under == 0) return "'" + text + "' is neither a number nor a fraction";
        std::array<char, 32> digits{};
        const auto written =
            std::to_chars(digits.data(), digits.data() + digits.size(), over / under);
        text.assign(digits.data(), written.ptr);
        return {};
    },
    "");

const CLI::Validator blockSize(
    [](std::string& text) -> std::string {
        int value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool number = error == std::errc() && end == text.data() + text.size();
        if (number && value >= 32 && value <= 1024 && value % 32 == 0) return {};
        return "'" + text + "' is not a multiple of 32 from 32 to 1024";
    },
    "");

const CLI::Validator fileName(
    [](std::string& text) { return text.empty() ? std::string("is empty") : std::string(); }, "");

std::string keyAndValue(const std::string& text) {
    if (text.find('=') != std::string::npos) return {};
    return "'" + text + "' is not KEY=VALUE";
}

PartitionerConfig makePartitionerConfig(const RawOptions& raw) {
    // Wrong values are refused whether or not the partitioner that was chosen has use for them.
    const Vec2 cellSize = parseCellSize(raw.cellSize);
    const auto rebuild = parseRebuild(raw.rebuild);
    PartitionerConfig config = find(partitioners(), raw.partitioner).value();
    if (auto* grid = std::get_if<StaticGrid>(&config)) *grid = {cellSize};
    if (auto* tree = std::get_if<Quadtree>(&config)) *tree = {raw.maxDepth, raw.maxPerCell};
    if (auto* tree = std::get_if<SemiStaticQuadtree>(&config)) {
        *tree = {raw.maxDepth, raw.maxPerCell, rebuild};
    }
    return config;
}

/// Each with what it is good for.
template <class Kind>
std::string alternativesWithMeaning(std::span<const Named<Kind>> all) {
    std::string text;
    for (const Named<Kind>& named : all) {
        text +=
            (text.empty() ? "" : "; ") + std::string(named.name) + ": " + std::string(named.about);
    }
    return text;
}

void declare(CLI::App& app, Options& options, RawOptions& raw) {
    app.set_version_flag("--version",
                         std::string("collisionStress ") + version + " (" + commit() + ")");
    app.get_formatter()->column_width(38);

    auto* scene = app.add_option("scene,--scene", options.scene,
                                 "A name in scenes/ or a scene file (" + options.scene + "; " +
                                     openingScene + " in a window)")
                      ->type_name("NAME|FILE")
                      ->group("Scene");
    auto* set = app.add_option("--set", options.set,
                               "Put a value in place of the scene's: step.restitution=0.5, "
                               "spawn.0.count=1000; may be given often")
                    ->check(CLI::Validator(keyAndValue, ""))
                    ->allow_extra_args(false)
                    ->type_name("KEY=VALUE")
                    ->group("Scene");
    auto* entities = app.add_option("--entities", options.entities,
                                    "Count of the scene's first spawn group (the scene's)")
                         ->check(wholeNumber)
                         ->type_name("N")
                         ->group("Scene");
    auto* seed = app.add_option("--seed", options.seed, "Random seed (the scene's)")
                     ->check(wholeNumber)
                     ->type_name("S")
                     ->group("Scene");
    app.add_option("--load", options.load, "Resume from a snapshot")
        ->check(fileName)
        ->type_name("FILE")
        ->group("Scene")
        ->excludes(scene)
        ->excludes(set)
        ->excludes(entities)
        ->excludes(seed);
    app.add_option("--dt", options.dt, "Length of a step in s, also as 1/60 (the scene's)")
        ->transform(fraction)
        ->check(positiveNumber())
        ->type_name("SECONDS")
        ->group("Scene");
    app.add_option("--restitution", options.restitution, "From 0 to 1 (the scene's)")
        ->check(finiteNumber([](double value) { return value >= 0 && value <= 1; }, "from 0 to 1"))
        ->type_name("E")
        ->group("Scene");

    app.add_option("--partitioner", raw.partitioner, alternatives(partitioners()))
        ->check(oneOf(namesOf(partitioners())))
        ->type_name("NAME")
        ->capture_default_str()
        ->group("Collisions");
    app.add_option("--cell-size", raw.cellSize, "Cells of the static grid in px")
        ->type_name("W,H")
        ->capture_default_str()
        ->group("Collisions");
    app.add_option("--max-depth", raw.maxDepth, "Levels of a quadtree below its root")
        ->check(CLI::Range(0, 15))
        ->type_name("D")
        ->capture_default_str()
        ->group("Collisions");
    app.add_option("--max-per-cell", raw.maxPerCell, "Bodies in a leaf before it splits")
        ->check(CLI::Range(1, 1'000'000'000))
        ->type_name("M")
        ->capture_default_str()
        ->group("Collisions");
    app.add_option("--rebuild", raw.rebuild,
                   "When the semi-static tree is rebuilt: skin (before a body leaves its inflated "
                   "box; skin:WIDTH fixes the width in px) or every:K frames (misses pairs)")
        ->type_name("POLICY")
        ->capture_default_str()
        ->group("Collisions");
    app.add_option("--resolver", raw.resolver, alternativesWithMeaning(resolvers()))
        ->check(oneOf(namesOf(resolvers())))
        ->type_name("NAME")
        ->capture_default_str()
        ->group("Collisions");
    app.add_option("--threads", options.threads,
                   "Threads of the host, unless one core is to do it (all cores)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N")
        ->group("Collisions");
    app.add_option("--block-size", options.cuda.blockSize,
                   "Threads in a block of the resolver 'cuda', a multiple of 32")
        ->check(blockSize)
        ->type_name("N")
        ->capture_default_str()
        ->group("Collisions");
    app.add_option("--cuda-thread", raw.cudaThread,
                   "What a thread of the resolver 'cuda' looks after: a cell, as in the report, or "
                   "a body in a cell")
        ->check(oneOf({"cell", "body"}))
        ->type_name("cell|body")
        ->capture_default_str()
        ->group("Collisions");
    app.add_flag("!--no-fallback", options.fallback,
                 "A resolver that cannot run is an error, not a reason to run the sequential one")
        ->group("Collisions");
    app.add_option("--law", raw.law,
                   alternatives(laws()) + " (" + std::string(name(SimulationConfig{}.law)) + ")")
        ->check(oneOf(namesOf(laws())))
        ->type_name("NAME")
        ->group("Collisions");
    app.add_option("--precision", raw.precision,
                   alternatives(precisions()) + " (" +
                       std::string(name(SimulationConfig{}.precision)) + ")")
        ->check(oneOf(namesOf(precisions())))
        ->type_name("NAME")
        ->group("Collisions");

    app.add_flag("--headless", options.headless, "Run without a window")->group("Run");
    app.add_option("--frames", options.frames, "Stop after so many frames")
        ->check(wholeNumber)
        ->type_name("N")
        ->group("Run");
    app.add_option("--duration", options.duration, "Stop after so many seconds of wall time")
        ->check(positiveNumber())
        ->type_name("S")
        ->group("Run");
    app.add_option("--report-every", options.reportEvery, "Seconds between two reports")
        ->check(positiveNumber())
        ->type_name("S")
        ->capture_default_str()
        ->group("Run");
    app.add_flag("--profile", options.profile, "Measure the phases of a frame")->group("Run");
    app.add_flag("--error", options.error, "Measure the error against the event-driven reference")
        ->group("Run");
    app.add_option("--compare", raw.compare,
                   "Hold this run against another from the same start: impulse,continuous, or "
                   "what else they differ in, as dt=1/60,1/240; may be given for several options")
        ->allow_extra_args(false)
        ->type_name("[OPTION=]A,B")
        ->group("Run");
    app.add_flag("--force-memory", options.forceMemory,
                 "Run even what needs more memory than there is")
        ->group("Run");

    app.add_option("--json", options.json, "Write the run's summary ('-' is stdout)")
        ->check(fileName)
        ->type_name("FILE")
        ->group("Output");
    app.add_option("--csv", options.csv, "Write a row for each frame ('-' is stdout)")
        ->check(fileName)
        ->type_name("FILE")
        ->group("Output");
    app.add_option("--dump-state", options.dumpState, "Write the final state as CSV")
        ->check(fileName)
        ->type_name("FILE")
        ->group("Output");
    app.add_option("--dump-events", options.dumpEvents, "Write every collision as CSV")
        ->check(fileName)
        ->type_name("FILE")
        ->group("Output");
    auto* save = app.add_option("--save", options.save, "Write a snapshot at the end")
                     ->check(fileName)
                     ->type_name("FILE")
                     ->group("Output");
    app.add_option("--save-every", options.saveEvery,
                   "Write that snapshot after every so many frames, too: what a run that is killed "
                   "goes on from")
        ->check(wholeNumber)
        ->check(notZero)
        ->type_name("FRAMES")
        ->group("Output")
        ->needs(save);
    app.add_flag("--explain", options.explain,
                 "Print what the scene makes the engine model, and exit")
        ->group("Output");
    app.add_flag("--list", options.list, "List scenes, partitioners, resolvers and laws, and exit")
        ->group("Output");
    app.add_option("--generate", raw.generate,
                   "Print these options as a manual page or as a completion script, and exit")
        ->check(oneOf({"man", "complete-bash"}))
        ->type_name("man|complete-bash")
        ->group("Output");
    declareWindowOptions(app, options.window);
    app.footer(
        "Results go to stdout, messages to stderr.\n"
        "Exit codes: 0 done, 1 run-time failure, 2 usage, 3 bad scene or snapshot, 4 no such "
        "device, 128 + N ended by signal N.");
}

/// Whether an output would take the place of another file, or mix with it. Devices take anything.
bool collide(const std::string& output, const std::string& other) {
    if (output.empty() || other.empty() || output == "-" || other == "-") return false;
    std::error_code error;
    return sameFile(output, other) && !std::filesystem::is_character_file(output, error);
}

/// Two outputs would write over each other, under one name or two, and an output over an input.
void refuseSharedFiles(const Options& options) {
    const std::array<std::pair<const char*, const std::string*>, 7> outputs = {{
        {"--json", &options.json},
        {"--csv", &options.csv},
        {"--dump-state", &options.dumpState},
        {"--dump-events", &options.dumpEvents},
        {"--save", &options.save},
        {"--screenshot", &options.window.screenshot},
        {"--video", &options.window.video},
    }};
    const auto refuse = [](const char* first, const char* second) {
        throw UsageError(std::string(first) + " and " + second + " name the same file");
    };
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto& [option, file] = outputs[i];
        for (std::size_t j = 0; j < i; ++j) {
            if (collide(*file, *outputs[j].second)) refuse(outputs[j].first, option);
        }
        if (isScenePath(options.scene) && collide(*file, options.scene)) refuse("--scene", option);
        // A run may go on from a snapshot and leave the next one in its place.
        if (file != &options.save && collide(*file, options.load)) refuse("--load", option);
        if (*file != "-" && isStandardStream(*file)) {
            throw UsageError(std::string(option) + ": " + *file +
                             " is where stdout or stderr goes; '-' is stdout");
        }
    }
}

/// Turns what was typed into what the program needs, and refuses what it cannot do.
void interpret(Options& options, const RawOptions& raw) {
    options.partitioner = makePartitionerConfig(raw);
    options.resolver = find(resolvers(), raw.resolver).value();
    const bool inWindow = !options.headless && !options.explain;
    if (inWindow && !raw.sceneGiven) options.scene = openingScene;
    options.law = find(laws(), raw.law);
    options.precision = find(precisions(), raw.precision);
    options.cuda.threadPer = raw.cudaThread == "cell" ? CudaThread::Cell : CudaThread::Body;
    if (options.error && options.frames == 0) {
        throw UsageError("--error: there is nothing to compare after --frames 0");
    }
    if (options.headless && options.window.offscreen) {
        throw UsageError("--offscreen draws what --headless leaves out: give one of the two");
    }
    for (const auto& [option, file] : {std::pair("--screenshot", &options.window.screenshot),
                                       std::pair("--video", &options.window.video)}) {
        if (options.headless && !file->empty()) {
            throw UsageError(std::string(option) + ": there is nothing to see with --headless");
        }
    }
    if (options.window.offscreen && options.window.paused && !options.window.video.empty()) {
        throw UsageError(
            "--video: nothing would move, as nobody can end --paused with --offscreen");
    }
    int onStdout = 0;
    for (const std::string* file :
         {&options.json, &options.csv, &options.dumpState, &options.dumpEvents}) {
        onStdout += *file == "-";
    }
    if (onStdout > 1) throw UsageError("only one output can go to stdout ('-')");
    refuseSharedFiles(options);
    if (options.save == "-") throw UsageError("--save: a snapshot cannot go to stdout");
    if (options.window.screenshot == "-") {
        throw UsageError("--screenshot: a picture cannot go to stdout");
    }
}

/// What to say of options that are not known, with those that they may have meant.
std::optional<CLI::ExtrasError> refuseUnknownOptions(const CLI::App& app) {
    std::vector<std::string> known;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) known.push_back(name);
    }
    const std::vector<std::string> unexpected = app.remaining();
    std::vector<std::string> meant;
    bool unknown = false;
    for (const std::string_view argument : unexpected) {
        if (!argument.starts_with('-')) continue;
        unknown = true;
        const std::string_view name = argument.substr(0, argument.find('='));
        const std::size_t start = std::min(name.find_first_not_of('-'), name.size());
        for (const std::string& nearest : nearestNames(name.substr(start), known)) {
            const std::string option = "--" + nearest;
            if (std::find(meant.begin(), meant.end(), option) == meant.end()) {
                meant.push_back(option);
            }
        }
    }
    if (!unknown) return std::nullopt;
    return CLI::ExtrasError(CLI::ExtrasError(unexpected).what() + didYouMean(meant),
                            CLI::ExitCodes::ExtrasError);
}

/// In what two runs differ that are to be compared.
struct Difference {
    std::string option;  ///< without dashes
    std::array<std::string, 2> values;
};

/// What changes how a run goes on, and not where it starts.
const std::vector<std::string> comparable = {
    "law",       "dt",           "precision", "restitution", "partitioner", "cell-size",
    "max-depth", "max-per-cell", "rebuild",   "resolver",    "threads"};

Difference parseDifference(const std::string& text) {
    const auto refuse = [&](const std::string& reason) {
        throw UsageError("--compare: '" + text + "' " + reason);
    };
    const std::size_t equals = text.find('=');
    const bool named = equals != std::string::npos;
    Difference difference{.option = named ? text.substr(0, equals) : "law", .values = {}};
    if (std::find(comparable.begin(), comparable.end(), difference.option) == comparable.end()) {
        std::string names;
        for (const std::string& name : comparable) names += (names.empty() ? "" : ", ") + name;
        refuse("names no option in which two runs can differ; those are: " + names +
               didYouMean(nearestNames(difference.option, comparable)));
    }
    const std::string values = text.substr(named ? equals + 1 : 0);
    const std::size_t comma = values.find(',');
    if (comma == std::string::npos || values.find(',', comma + 1) != std::string::npos) {
        refuse("is not two values with a comma between them");
    }
    difference.values = {values.substr(0, comma), values.substr(comma + 1)};
    if (difference.values[0].empty() || difference.values[1].empty()) refuse("lacks a value");
    if (difference.values[0] == difference.values[1]) refuse("names the same twice");
    return difference;
}

std::vector<Difference> parseDifferences(const CLI::App& app, const RawOptions& raw) {
    std::vector<Difference> differences;
    for (const std::string& text : raw.compare) {
        Difference next = parseDifference(text);
        if (app.count("--" + next.option) > 0) {
            throw UsageError("--compare: '" + text + "' and --" + next.option +
                             " say the same of a run");
        }
        for (const Difference& other : differences) {
            if (other.option == next.option) {
                throw UsageError("--compare: " + next.option + " is given twice");
            }
        }
        differences.push_back(std::move(next));
    }
    return differences;
}

/// "impulse", or "dt 1/240" where it is not the law.
std::string labelOf(const std::vector<Difference>& differences, std::size_t run) {
    std::string label;
    for (const Difference& difference : differences) {
        if (!label.empty()) label += ", ";
        if (difference.option != "law") label += difference.option + ' ';
        label += difference.values[run];
    }
    return label;
}

/// Also says what two runs are to differ in, if that is asked for.
ParsedOptions parseOnce(const std::vector<const char*>& arguments,
                        std::vector<Difference>* differences) {
    CLI::App app("Runs and measures 2D rigid-box scenes.", "collisionStress");
    Options options;
    RawOptions raw;
    declare(app, options, raw);
    try {
        app.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
        // The value of an unknown option is taken for a scene, and what comes of that says less.
        const auto unknown = asked ? std::nullopt : refuseUnknownOptions(app);
        app.exit(unknown ? *unknown : error, std::cout, std::cerr);
        return {.options = std::nullopt, .exitCode = asked ? done : usageError};
    }
    if (!raw.generate.empty()) {
        raw.generate == "man" ? writeManual(std::cout, app) : writeBashCompletion(std::cout, app);
        return {.options = std::nullopt, .exitCode = done};
    }
    if (differences != nullptr) *differences = parseDifferences(app, raw);
    raw.sceneGiven = app.get_option("--scene")->count() > 0;
    interpret(options, raw);
    return {.options = std::move(options), .exitCode = done};
}

/// The same command line, and what --compare says in it of one of the runs.
ParsedOptions parseRun(const std::vector<const char*>& typed,
                       const std::vector<Difference>& differences, std::size_t run) {
    std::vector<std::string> words;
    for (const Difference& difference : differences) {
        words.push_back("--" + difference.option + '=' + difference.values[run]);
    }
    std::vector<const char*> arguments = {typed.front()};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    arguments.insert(arguments.end(), typed.begin() + 1, typed.end());
    ParsedOptions parsed = parseOnce(arguments, nullptr);
    if (parsed.options) parsed.options->label = labelOf(differences, run);
    return parsed;
}

}  // namespace

ParsedOptions parseOptions(int argc, const char* const* argv) {
    const std::vector<const char*> typed(argv, argv + argc);
    std::vector<Difference> differences;
    ParsedOptions parsed = parseOnce(typed, &differences);
    if (differences.empty() || !parsed.options) return parsed;
    parsed = parseRun(typed, differences, 0);
    ParsedOptions other = parsed.options ? parseRun(typed, differences, 1) : ParsedOptions{};
    if (!other.options) return parsed.options ? other : parsed;
    parsed.options->beside = std::make_shared<const Options>(std::move(*other.options));
    return parsed;
}

}  // namespace quadrille::app

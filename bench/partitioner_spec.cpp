#include "bench/partitioner_spec.hpp"

#include <array>
#include <charconv>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>

#include "bench/table.hpp"

namespace quadrille::bench {

namespace {

/// The part of a spec after the name, read field by field.
class Fields {
  public:
    Fields(std::string_view spec, std::string_view fields) : spec_(spec), rest_(fields) {}

    bool done() const { return rest_.empty(); }

    /// Up to the separator, which is dropped, or up to the end.
    std::string_view next(char separator) {
        const auto end = rest_.find(separator);
        const auto field = rest_.substr(0, end);
        rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
        return field;
    }

    template <class T>
    T numberIn(std::string_view field) const {
        T value{};
        const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
        if (error != std::errc() || end != field.data() + field.size()) fail();
        return value;
    }

    template <class T>
    T nextNumber(char separator) {
        return numberIn<T>(next(separator));
    }

    [[noreturn]] void fail() const {
        throw Error("partitioner '" + std::string(spec_) + "' is none of: " + partitionerSpecs());
    }

  private:
    std::string_view spec_, rest_;
};

void read(Fields&, BruteForce&) {}

void read(Fields& fields, StaticGrid& grid) {
    const auto width = fields.nextNumber<double>('x');
    grid.cellSize = Vec2(width, fields.nextNumber<double>('/'));
}

template <class Tree>
void readTree(Fields& fields, Tree& tree) {
    tree.maxDepth = fields.nextNumber<int>('/');
    tree.maxPerCell = fields.nextNumber<int>('/');
}

void read(Fields& fields, Quadtree& tree) { readTree(fields, tree); }

void read(Fields& fields, SemiStaticQuadtree& tree) {
    constexpr std::string_view skin = "skin=", every = "every=";
    readTree(fields, tree);
    if (fields.done()) return;
    const auto policy = fields.next('/');
    if (policy.starts_with(skin)) {
        const auto width = fields.numberIn<double>(policy.substr(skin.size()));
        tree.rebuild = SemiStaticQuadtree::Skin{width};
    } else if (policy.starts_with(every)) {
        const auto frames = fields.numberIn<int>(policy.substr(every.size()));
        tree.rebuild = SemiStaticQuadtree::EveryFrames{frames};
    } else if (policy != "skin") {
        fields.fail();
    }
}

std::string parametersOf(const BruteForce&) { return ""; }

std::string parametersOf(const StaticGrid& grid) {
    return number(grid.cellSize.x()) + 'x' + number(grid.cellSize.y());
}

template <class Tree>
std::string treeParametersOf(const Tree& tree) {
    return std::to_string(tree.maxDepth) + '/' + std::to_string(tree.maxPerCell);
}

std::string parametersOf(const Quadtree& tree) { return treeParametersOf(tree); }

std::string parametersOf(const SemiStaticQuadtree& tree) {
    const std::string parameters = treeParametersOf(tree);
    if (const auto* every = std::get_if<SemiStaticQuadtree::EveryFrames>(&tree.rebuild)) {
        return parameters + "/every=" + std::to_string(every->frames);
    }
    const double width = std::get<SemiStaticQuadtree::Skin>(tree.rebuild).width;
    return parameters + (width > 0 ? "/skin=" + number(width) : "/skin");
}

}  // namespace

PartitionerConfig parsePartitioner(std::string_view spec) {
    const auto colon = spec.find(':');
    const bool bare = colon == std::string_view::npos;
    Fields fields(spec, bare ? std::string_view() : spec.substr(colon + 1));
    auto config = find(partitioners(), spec.substr(0, colon));
    if (!config) fields.fail();
    if (!bare) std::visit([&](auto& partitioner) { read(fields, partitioner); }, *config);
    if (!fields.done()) fields.fail();
    return *config;
}

std::string partitionerSpecs() {
    constexpr std::array forms = {"", ":WxH", ":DEPTH/MAX", ":DEPTH/MAX[/skin|/skin=W|/every=K]"};
    std::string text;
    for (const auto& named : partitioners()) {
        text += (text.empty() ? "" : ", ") + std::string(named.name) + forms[named.kind.index()];
    }
    return text;
}

std::string specOf(const PartitionerConfig& config) {
    const std::string parameters =
        std::visit([](const auto& partitioner) { return parametersOf(partitioner); }, config);
    const std::string spec(name(config));
    return parameters.empty() ? spec : spec + ':' + parameters;
}

}  // namespace quadrille::bench

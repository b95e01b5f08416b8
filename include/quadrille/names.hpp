#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <quadrille/config.hpp>
#include <quadrille/step_report.hpp>

/// The names of everything that can be chosen, both ways; the command line, files and every output
/// use them.

namespace quadrille {

template <class Kind>
struct Named {
    Kind kind;
    std::string_view name;
    std::string_view about;  ///< what it is good for, half a sentence
};

/// All that there are, in the order in which they are listed.
std::span<const Named<Law>> laws();
std::span<const Named<ResolverKind>> resolvers();
std::span<const Named<Precision>> precisions();
/// Each with its default parameters.
std::span<const Named<PartitionerConfig>> partitioners();

std::string_view name(Law law);
std::string_view name(ResolverKind resolver);
std::string_view name(Precision precision);
std::string_view name(const PartitionerConfig& config);
std::string_view name(Phase phase);

/// What has the name, or nothing.
template <class Kind>
std::optional<Kind> find(std::span<const Named<Kind>> all, std::string_view name) {
    for (const Named<Kind>& named : all) {
        if (named.name == name) return named.kind;
    }
    return std::nullopt;
}

/// The names of all that there are.
template <class Kind>
std::vector<std::string> namesOf(std::span<const Named<Kind>> all) {
    std::vector<std::string> names;
    for (const Named<Kind>& named : all) names.emplace_back(named.name);
    return names;
}

/// "a, b or c".
template <class Kind>
std::string alternatives(std::span<const Named<Kind>> all) {
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) text += i + 1 < all.size() ? ", " : " or ";
        text += all[i].name;
    }
    return text;
}

/// Those that a mistyped name may have meant, in the order of `names`: those that the fewest typing
/// errors lead to, a letter too much, missing, wrong or swapped with the next, in at most a third
/// of the letters. Capitals are no error.
std::vector<std::string> nearestNames(std::string_view typed, std::span<const std::string> names);

/// "; did you mean 'a' or 'b'?" for the end of a message, or nothing if there are none.
std::string didYouMean(std::span<const std::string> nearest);

/// Whether the law runs on the resolver. `Auto` runs every law.
bool runsOn(Law law, ResolverKind resolver);

/// Whether the resolver is nothing without a CUDA device. `Auto` takes one only if it is there.
bool needsDevice(ResolverKind resolver);

}  // namespace quadrille

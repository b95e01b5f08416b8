#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/engine.hpp"

namespace quadrille {

/// An engine that is replaced by another one, with the same result, when its device is missing or
/// fails: at once, or in the middle of a step. The state is the failing engine's matter: `cuda` has
/// changed nothing by then (law.hpp), and `cuda-resident` repeats the steps that only the device
/// has done (ResidentEngine::repeatSteps).
class FallbackEngine final : public Engine {
  public:
    using Make = std::function<std::unique_ptr<Engine>()>;

    /// `first` is called here, `substitute` when it is needed.
    FallbackEngine(const Make& first, Make substitute);

    void step(BodyStore& store, StepWindow& window, StepReport& report) override;

    const Cells& cells() const override { return engine_->cells(); }
    std::span<const ContactRecord> contacts() override { return engine_->contacts(); }
    ResolverKind resolver() const override { return engine_->resolver(); }
    const std::string& failure() const override { return failure_; }
    unsigned threads() const override { return engine_->threads(); }
    std::size_t bytes() const override { return engine_->bytes(); }

  private:
    Make substitute_;
    std::unique_ptr<Engine> engine_;
    std::string failure_;
};

}  // namespace quadrille

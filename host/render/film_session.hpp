// The film file of a render: where it goes on from, which passes it adds, and when the file is written.
#pragma once

#include <future>
#include <optional>
#include <string>

#include "film/film_file.hpp"
#include "integrators/integrator.hpp"
#include "render/render.hpp"
#include "render/several_devices.hpp"

namespace causticl {

class FilmSession {
 public:
  /// Reads the film to go on from, if there is one. Throws UserError where it is of another render, or the
  /// options do not go together.
  FilmSession(const Scene& scene, const RenderOptions& options);
  ~FilmSession();
  FilmSession(const FilmSession&) = delete;
  FilmSession& operator=(const FilmSession&) = delete;

  /// The passes that the render adds, where the scene wants `wanted`.
  PassRange passes(std::uint64_t wanted) const;

  /// What earlier runs have done; none where the render begins anew.
  const std::optional<FilmState>& earlier() const { return earlier_; }

  /// What the user should know of it, where `device` goes on; empty where there is none.
  std::string notice(const std::string& device) const;

  /// Puts that on the devices. Throws UserError where passes depend on others that are not there.
  void restore(const std::vector<std::unique_ptr<RenderDevice>>& devices, PassIntegrator& integrator);

  /// Whether a file is to be written while passes go on, `seconds` after the first began; no file is being
  /// written.
  bool due(double seconds);
  /// Takes the film from the device and writes it while passes go on.
  void write(Film& film, PassIntegrator& integrator, const Statistics& statistics);
  /// The fault of the last write; empty where there is none. Waits for it where `wait`.
  std::string take_fault(bool wait);

  /// How long passes stood still for the longest of these writes.
  double longest_stop() const { return longest_stop_; }

 private:
  const RenderOptions& options_;
  std::optional<FilmState> earlier_;
  FilmState base_;  // all but what a film adds up
  double last_write_ = 0, longest_stop_ = 0;
  std::future<std::string> writing_;
};

}  // namespace causticl

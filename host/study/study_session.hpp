// A study under way: what its parts share.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "base/folder_lock.hpp"
#include "study/study_plan.hpp"
#include "study/study_render.hpp"
#include "study/study_store.hpp"

namespace causticl {

class StudySession {
 public:
  /// Opens the folder of the request: a new study, or the one that it holds. Throws UserError for a study of
  /// something else, and for whatever else is at fault in the request.
  StudySession(const StudyRequest& request, KernelCache& kernels, std::function<void(const std::string&)> say,
               std::function<bool()> interrupted);

  const StudyRequest& request;
  const std::function<void(const std::string&)> say;
  const std::function<bool()> interrupted;
  std::string folder;
  FolderLock lock;  // of the folder, taken before anything in it is looked at
  StudyBudget budget;
  RenderChange own_change;  // an --integrator that the user gave
  Study study;
  StudyRenderer renderer;
  Picture reference;

  /// Seconds of the budget so far, those of earlier calls included.
  double spent() const;
  std::string path(const std::string& name) const;
  /// Writes study.json and study.csv.
  void save();

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double spent_before_ = 0;
};

/// Fills in session.reference and its noise: the picture of --reference, the one that the folder holds, or a
/// new one. Without effect on the study where the session is interrupted.
void make_reference(StudySession& session);

/// The file of a setting's picture within the folder of a study.
std::string picture_name(const StudySetting& setting);

}  // namespace causticl

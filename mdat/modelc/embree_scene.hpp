// Owning handles for an Embree device and one scene. Embree throws nothing: errors surface as CompileError when a scene is committed.
#pragma once

#include <embree3/rtcore.h>

#include "mdat/modelc/surface.hpp"

namespace lasso::mdat {

class EmbreeScene {
 public:
  EmbreeScene();
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  void add_triangles(const Surface& surface);  // all but slivers
  // `count` primitives known by their bounds; `query` answers point queries on them. `user` must outlive the scene.
  void add_user(unsigned count, RTCBoundsFunction bounds, RTCPointQueryFunction query, void* user);
  void commit();  // throws CompileError
  // Does a ray from `from` meet nothing?
  bool escapes(const Vec3d& from, const Vec3d& direction) const;
  // Range of the first triangle that a ray of unit direction meets, infinity where there is none.
  double first_hit(const Vec3d& from, const Vec3d& direction) const;
  RTCScene scene() const { return scene_; }

 private:
  void attach(RTCGeometry geometry);
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace lasso::mdat

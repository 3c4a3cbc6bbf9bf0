// Many visible paths at once: those that come to a Lambert vertex end in a batch; the others take a step each before any takes
// the next, so that their rays go through the tree as a stream. Every path is what it is alone, to the bit.
#include "photons/visible_path.cl"
#include "traversal/ray_stream.cl"

#if DIFFUSE_VERTICES_BATCHED
// Paths for each item of a work-group, whose first item traces those of all.
#define VISIBLE_PATHS_AN_ITEM 4u

typedef struct {
  CameraPath path;
  Boundary boundary;
  VisiblePath visible;
} VisibleState;

typedef struct {
  const Scene *scene;
  const Params *params;
  global VisiblePoint *points;
  global const SppmPixel *pixels;
  volatile global Counters *counters;
  VisibleState states[STREAM_CAPACITY];
  uint slots[STREAM_CAPACITY];  // of `states`: first those of the paths that are on their way, then the free ones
  uint alive;
  DiffuseVertices vertices;
  uint vertex_count;
  uint rays;
  RAY_COMPONENTS(COMPONENT_FIELD, )
  HIT_COMPONENTS(COMPONENT_FIELD, )
} VisibleStream;

INLINE void visible_stream_put_ray(VisibleStream *state, uint i, Ray ray) { RAY_COMPONENTS(STORE_ENTRY, ray) }

INLINE Hit visible_stream_hit(const VisibleStream *state, uint i) {
  Hit hit;
  HIT_COMPONENTS(LOAD_ENTRY, hit)
  hit.diagnostics = 0;
  return hit;
}

// Takes a path past its hit. Returns whether it goes on.
OUTLINE bool visible_stream_step(VisibleStream *stream, VisibleState *state, Hit hit) {
  CameraPath path = state->path;
  VisiblePath visible = state->visible;
  uint next = visible_path_step(stream->scene, &path, &state->boundary, &visible, hit, stream->points, stream->pixels,
                                stream->counters);
  if (next == VISIBLE_GOES_ON) {
    ++path.bounce;
    state->path = path;
    state->visible = visible;
    return true;
  }
  stream->rays += path.rays;
  if (next == VISIBLE_LAMBERT) {
    DiffuseArrival arrival = {path.ray, hit, path.throughput, path.radiance.sum, path.counted, path.bounce,
                              visible.sampler.pixel, visible.sample};
    diffuse_vertices_put(&stream->vertices, stream->vertex_count++, &arrival);
  } else {
    visible_store(&path, &visible, stream->points);
  }
  return false;
}

// Adds path number `index` of the chunk to the stream, which has room for it, past its primary hit if that has been found.
OUTLINE void visible_stream_add(VisibleStream *stream, uint index) {
  VisibleState *state = stream->states + stream->slots[stream->alive];
  global const PrimaryHit *first = (global const PrimaryHit *)stream->points + index;
  state->path = visible_path_begin(stream->scene, stream->params, index, first, &state->boundary, &state->visible,
                                   stream->counters);
  bool goes_on = true;
  if (PRIMARY_HITS_FOUND) {
    Hit hit = hit_none(INFINITY);
    primary_hit(first, &hit);
    ++state->path.rays;
    goes_on = visible_stream_step(stream, state, hit);
  }
  stream->alive += goes_on ? 1u : 0u;
}

// Adds paths from `next` on while there is room. Returns the first that is not added.
OUTLINE uint visible_stream_fill(VisibleStream *stream, uint next, uint end) {
  const Scene *scene = stream->scene;
  const Params *params = stream->params;
  bool from_outside = !(nested(scene) && (scene->nested & NESTED_CAMERA)) && !beside_horizon(scene, params);
  for (; next < end && stream->alive < STREAM_CAPACITY && stream->vertex_count < STREAM_CAPACITY; ++next) {
    bool is_lambert = false;
    if (PRIMARY_HITS_FOUND && from_outside) {
      // Most paths end at what they meet first.
      global const PrimaryHit *found = (global const PrimaryHit *)stream->points + next;
      Hit hit = hit_none(INFINITY);
      is_lambert = primary_hit(found, &hit) && meets_lambert(scene, first_ray(found), hit);
      PathSampler sampler = chunk_sampler(params, params->visible_points, next);
      DiffuseArrival arrival = {first_ray(found), hit, (real3)(1, 1, 1), (real3)(0, 0, 0), false, 0, sampler.pixel,
                                next % params->visible_points};
      diffuse_vertices_put(&stream->vertices, stream->vertex_count, &arrival);
      stream->vertex_count += is_lambert ? 1u : 0u;
      stream->rays += is_lambert ? 1u : 0u;
    }
    if (!is_lambert) visible_stream_add(stream, next);
  }
  return next;
}

OUTLINE void visible_stream_finish_vertices(VisibleStream *stream) {
  stream->rays += diffuse_vertices_finish(stream->scene, stream->params, stream->vertex_count, &stream->vertices,
                                          stream->points, stream->pixels, stream->counters);
  stream->vertex_count = 0;
}

// Whether what the path meets next is known, without a ray: see media_closest().
INLINE bool visible_in_gap(const Scene *scene, const VisibleState *state) {
  return nested(scene) && state->boundary.media.contact != CONTACT_NONE;
}

// Takes every path to its next hit and past that.
OUTLINE void visible_stream_trace(VisibleStream *stream) {
  uint ray_of[STREAM_CAPACITY], ray_count = 0;
  for (uint k = 0; k < stream->alive; ++k) {
    VisibleState *state = stream->states + stream->slots[k];
    ray_of[k] = ray_count;
    if (!visible_in_gap(stream->scene, state)) visible_stream_put_ray(stream, ray_count++, state->path.ray);
  }
  RayArrays rays = RAY_ARRAYS(stream);
  rays_closest(&stream->scene->geometry, &rays, ray_count, stream->counters);
  // From the last on, so that a path which ends gives its place to one that has taken its step.
  for (uint k = stream->alive; k-- > 0;) {
    VisibleState *state = stream->states + stream->slots[k];
    Hit hit = hit_none(INFINITY);
    if (visible_in_gap(stream->scene, state))
      media_closest(stream->scene, &state->boundary.media, state->path.ray, &hit);
    else
      hit = visible_stream_hit(stream, ray_of[k]);
    ++state->path.rays;
    if (visible_stream_step(stream, state, hit)) continue;
    uint slot = stream->slots[k], last = --stream->alive;
    stream->slots[k] = stream->slots[last];
    stream->slots[last] = slot;
  }
}

// Paths [first, end) of the chunk. Returns the number of rays.
OUTLINE uint visible_paths(const Scene *scene, const Params *params, uint first, uint end,
                           global VisiblePoint *visible_points, volatile global Counters *counters,
                           global const SppmPixel *pixels) {
  VisibleStream stream;
  stream.scene = scene, stream.params = params;
  stream.points = visible_points, stream.pixels = pixels, stream.counters = counters;
  stream.alive = stream.vertex_count = stream.rays = 0;
  for (uint i = 0; i < STREAM_CAPACITY; ++i) stream.slots[i] = i;
  while (first < end || stream.alive > 0) {
    first = visible_stream_fill(&stream, first, end);
    // Every path on its way may come to a vertex.
    if (stream.vertex_count == STREAM_CAPACITY || stream.vertex_count + stream.alive > STREAM_CAPACITY)
      visible_stream_finish_vertices(&stream);
    if (first < end && stream.alive < STREAM_CAPACITY / 2u) continue;
    visible_stream_trace(&stream);
  }
  visible_stream_finish_vertices(&stream);
  return stream.rays;
}
#endif

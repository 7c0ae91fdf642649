// Embree's single rays, robust, over the mesh and the rays of a file that `cargo bench --bench rays -- write` has made.
//
// embree FILE HITS [high]: prints processor time a ray of each kind in ns, and writes what was hit. `high` builds by Embree's
// slowest builder, with spatial splits.

#include <embree3/rtcore.h>

#include <time.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

static const char *KINDS[] = {"camera", "diffuse", "random", "shadow"};
static const int TURNS = 3;

struct Ray {
  float origin[3], direction[3], far;
};

struct Found {
  float t;
  uint32_t triangle;
};

static double seconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time.tv_sec + 1e-9 * time.tv_nsec;
}

template <class T> static void take(FILE *file, T *into, size_t count) {
  if (fread(into, sizeof(T), count, file) != count) {
    fprintf(stderr, "the file ends early\n");
    exit(1);
  }
}

static RTCRay ray_of(const Ray &ray) {
  RTCRay r;
  r.org_x = ray.origin[0], r.org_y = ray.origin[1], r.org_z = ray.origin[2];
  r.dir_x = ray.direction[0], r.dir_y = ray.direction[1], r.dir_z = ray.direction[2];
  r.tnear = 0, r.tfar = ray.far, r.time = 0;
  r.mask = -1u, r.id = 0, r.flags = 0;
  return r;
}

static Found closest(RTCScene scene, RTCIntersectContext *context, const Ray &ray) {
  RTCRayHit hit;
  hit.ray = ray_of(ray);
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, context, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {-1, 0};
  return {hit.ray.tfar, hit.hit.primID};
}

static Found occluded(RTCScene scene, RTCIntersectContext *context, const Ray &ray) {
  RTCRay r = ray_of(ray);
  rtcOccluded1(scene, context, &r);
  return {r.tfar < 0 ? 0.0f : -1.0f, 0};
}

int main(int argc, char **argv) {
  if (argc < 3) return fprintf(stderr, "embree FILE HITS [high]\n"), 2;
  FILE *file = fopen(argv[1], "rb"), *out = fopen(argv[2], "wb");
  if (!file || !out) return perror("embree"), 1;
  uint32_t counts[3];
  take(file, counts, 3);

  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  bool high = argc > 3 && !strcmp(argv[3], "high");
  rtcSetSceneBuildQuality(scene, high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto buffer = [&](RTCBufferType type, RTCFormat format, uint32_t count) {
    return rtcSetNewGeometryBuffer(mesh, type, 0, format, 12, count);
  };
  take(file, (float *)buffer(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, counts[0]), 3 * size_t(counts[0]));
  take(file, (uint32_t *)buffer(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, counts[1]), 3 * size_t(counts[1]));
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene, mesh);
  rtcCommitScene(scene);

  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::vector<Ray> rays(counts[2]);
  std::vector<Found> found(counts[2]);
  for (int kind = 0; kind < 4; kind++) {
    take(file, rays.data(), rays.size());
    bool shadow = kind == 3;
    double best = std::numeric_limits<double>::infinity();
    for (int turn = 0; turn < TURNS; turn++) {
      double start = seconds();
      for (size_t i = 0; i < rays.size(); i++)
        found[i] = shadow ? occluded(scene, &context, rays[i]) : closest(scene, &context, rays[i]);
      double took = seconds() - start;
      best = took < best ? took : best;
    }
    printf("%s %.1f\n", KINDS[kind], best / rays.size() * 1e9);
    fwrite(found.data(), sizeof(Found), found.size(), out);
  }
  fclose(out);
  return rtcGetDeviceError(device) == RTC_ERROR_NONE ? 0 : 1;
}

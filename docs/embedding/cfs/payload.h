/* What the app and other apps of cFS tell each other over the software bus, as C: payloads, which follow the header of a message. All are in the processor's
   own byte order. Units are SI. The sensor frame has z along the boresight, x right, y down. Times are microseconds of the clock CFE_PSP_GetTime.
   Padding is written out, so that a byte has one meaning. */
#ifndef LASSO_PAYLOAD_H
#define LASSO_PAYLOAD_H

#include <stdint.h>

#define LASSO_SAMPLES_PER_MESSAGE 64
#define LASSO_MAX_AIMED_RAYS 384
#define LASSO_PATH_BYTES 64

/* To the scanner. LASSO_ORDER_START takes a scan by the plan; the others leave it empty. */
enum { LASSO_ORDER_START = 0, LASSO_ORDER_ABORT = 1, LASSO_ORDER_PERMIT_LASER = 2, LASSO_ORDER_INHIBIT_LASER = 3 };

typedef struct {
  uint32_t order;
  uint32_t scan_id;
  int64_t start_us;    /* the first sample's time, or as soon after as the scanner can */
  int64_t duration_us; /* first to last sample */
  double phase_turns;  /* the plan, as fsw/sense/scan_plan.hpp and pattern.hpp say */
  double center[2];
  double half[2];
  uint16_t pattern; /* PatternKind */
  uint16_t points;
  uint16_t cycles_a;
  uint16_t cycles_b;
  uint32_t aimed_count;
  uint32_t spare;
  float aimed[LASSO_MAX_AIMED_RAYS][2]; /* on the tangent plane z = 1 */
} LASSO_Scan_Payload_t;

/* From the scanner: the next samples of a scan, in time order. */
typedef struct {
  int64_t t_us;
  float direction[3]; /* unit vector of the ray at its own time */
  float range_m;      /* along the ray; 0 unless a hit */
  float sigma_factor; /* 1, or by how much this range is noisier than the sensor's others */
  uint32_t state;     /* RayState: 0 hit, 1 miss, 2 invalid, 3 lost */
} LASSO_Sample_t;

typedef struct {
  uint32_t scan_id;
  uint16_t count;   /* samples that follow, at most LASSO_SAMPLES_PER_MESSAGE */
  uint8_t complete; /* 1: the scan's last sample is among them */
  uint8_t status;   /* Status: 0, or why the scan is lost (the table in fsw/sense/sensor.hpp) */
  LASSO_Sample_t samples[LASSO_SAMPLES_PER_MESSAGE];
} LASSO_Samples_Payload_t;

/* The pose of one scan: what other apps need of the component's packet `pose` (docs/icd/link.md), with its names. Quaternions are x, y, z, w. Use it only
   if valid is 1. */
typedef struct {
  int64_t t_measurement_us; /* at which the poses are stated */
  int64_t t_publication_us;
  double q_sensor_target[4];
  double p_sensor_target_m[3];
  double covariance[21]; /* upper triangle by rows: rotation about the target's origin, translation; sensor axes */
  double filter_q_sensor_target[4];
  double filter_p_sensor_target_m[3];
  double filter_omega_radps[3];
  double filter_v_mps[3];
  uint32_t scan_id;
  uint32_t image_crc;
  uint16_t weak;
  uint8_t valid;
  uint8_t reason;
  uint8_t mode;
  uint8_t spare[3];
} LASSO_Pose_Payload_t;

/* The command LASSO_START_TRACKING_CC: where another app says that the target is, at t_us. */
typedef struct {
  int64_t t_us;
  double q_sensor_target[4];
  double p_sensor_target_m[3];
  double omega_radps[3];
  double v_mps[3];
} LASSO_Start_Payload_t;

/* Housekeeping of the app itself; the component's is in its own packets. Counters are modulo their size. */
typedef struct {
  uint8_t commands;
  uint8_t errors; /* commands that were refused */
  uint8_t spare[2];
  uint32_t poses;
  uint32_t valid_poses;
  uint32_t packets;          /* of the component's telemetry */
  uint32_t telecommands;     /* of the component, handed to it */
  uint32_t sample_messages;  /* taken */
  uint32_t refused_messages; /* samples of another scan, or more than it has rays */
} LASSO_Housekeeping_Payload_t;

/* The table LASSO.Config: it holds from the app's next start. */
typedef struct {
  char image[LASSO_PATH_BYTES]; /* the flight image, by `mdat mission compile`: an OSAL path */
  uint16_t apid;                /* application process of the component, 1 to 2046 */
  uint16_t spare[3];
} LASSO_Config_t;

#endif

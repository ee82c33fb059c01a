/* Messages of the app on the software bus of cFS: identifiers, commands, and payloads behind the headers of cFE. The component's own packets are messages
   as they are (README.md). */
#ifndef LASSO_MESSAGE_H
#define LASSO_MESSAGE_H

#include <cfe.h>
#include <cfe_core_api_msgid_mapping.h>

#include "cfs/payload.h"

/* A mission may define others. */
#ifndef LASSO_CMD_TOPIC
#define LASSO_CMD_TOPIC 0xC0
#define LASSO_SEND_HK_TOPIC 0xC1
#define LASSO_HK_TOPIC 0xC0
#define LASSO_POSE_TOPIC 0xC1
#define LASSO_SCAN_TOPIC 0xC2
#define LASSO_SAMPLES_TOPIC 0xC3
#endif

#define LASSO_CMD_MID CFE_PLATFORM_CMD_TOPICID_TO_MIDV(LASSO_CMD_TOPIC)
#define LASSO_SEND_HK_MID CFE_PLATFORM_CMD_TOPICID_TO_MIDV(LASSO_SEND_HK_TOPIC)
#define LASSO_HK_MID CFE_PLATFORM_TLM_TOPICID_TO_MIDV(LASSO_HK_TOPIC)
#define LASSO_POSE_MID CFE_PLATFORM_TLM_TOPICID_TO_MIDV(LASSO_POSE_TOPIC)
#define LASSO_SCAN_MID CFE_PLATFORM_TLM_TOPICID_TO_MIDV(LASSO_SCAN_TOPIC)
#define LASSO_SAMPLES_MID CFE_PLATFORM_TLM_TOPICID_TO_MIDV(LASSO_SAMPLES_TOPIC)

/* Of the component with this APID: its telemetry, and the telecommands that it takes. */
#define LASSO_TELEMETRY_MID(apid) (0x0800 | (apid))
#define LASSO_TELECOMMAND_MID(apid) (0x1800 | (apid))

/* Function codes of LASSO_CMD_MID */
#define LASSO_NOOP_CC 0
#define LASSO_RESET_COUNTERS_CC 1
#define LASSO_START_TRACKING_CC 2
#define LASSO_STOP_TRACKING_CC 3

typedef struct {
  CFE_MSG_TelemetryHeader_t header;
  LASSO_Scan_Payload_t payload;
} LASSO_Scan_t;

typedef struct {
  CFE_MSG_TelemetryHeader_t header;
  LASSO_Samples_Payload_t payload;
} LASSO_Samples_t;

typedef struct {
  CFE_MSG_TelemetryHeader_t header;
  LASSO_Pose_Payload_t payload;
} LASSO_Pose_t;

typedef struct {
  CFE_MSG_TelemetryHeader_t header;
  LASSO_Housekeeping_Payload_t payload;
} LASSO_Housekeeping_t;

typedef struct {
  CFE_MSG_CommandHeader_t header;
  LASSO_Start_Payload_t payload;
} LASSO_Start_t;

#endif

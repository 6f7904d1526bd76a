/* The two tasks on FreeRTOS: an example to start from.

   HR must have a higher priority than LR. What reads your sensors is declared here, and yours to write. STACK_WORDS is
   $stack_words_are. */
#include <stdbool.h>
#include <stddef.h>

#include "FreeRTOS.h"
#include "task.h"

#include "tasks.h"

#ifndef PERIOD_MS
#define PERIOD_MS 10
#endif
#define HR_PRIORITY 4
#define LR_PRIORITY 3
#define STACK_WORDS $stack_words
$notifications
$read_u/* The measurement of step k, in y; false if it is lost. It is asked for M = DELAY_STEPS steps after k. */
extern bool read_measurement(int k, real y[$p]);

static TaskHandle_t lr_handle;

static void hr_task(void *unused)
{
    TickType_t woken = xTaskGetTickCount();
$awaited    (void)unused;
    for (int j = 0;; j++) {
        if ($arrives) {
$arrived            (void)$give_at_m; /* at m */
        }
        vTaskDelayUntil(&woken, pdMS_TO_TICKS(PERIOD_MS));
${read_call}        const unsigned events = hr_step($u);
        if ((events & HR_SENT) != 0u) {
            (void)$give_at_k; /* at k */
$await        }
        /* hr_state() is the estimate of this step */
    }
}

static void lr_task(void *unused)
{
    real y[$p];
    (void)unused;
    for (;;) {
        (void)$take_at_k; /* at k */
        const int k = lr_receive();
        (void)$take_at_m; /* at m */
        if (read_measurement(k, y)) {
            lr_measure(y);
        } else {
            lr_lost();
        }
    }
}

/* Before the scheduler starts. */
void filter_start(real x[$n], real P[$n][$n]);
void filter_start(real x[$n], real P[$n][$n])
{
    tasks_start(x, P);
    (void)xTaskCreate(lr_task, "LR", STACK_WORDS, NULL, LR_PRIORITY, &lr_handle);
    (void)xTaskCreate(hr_task, "HR", STACK_WORDS, NULL, HR_PRIORITY, NULL);
    (void)$give_at_k; /* step 0 is a k */
}

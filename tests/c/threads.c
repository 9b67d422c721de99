/* Runs 8 instances in each of 8 threads, all of them different rotors, and the same 64 one after
 * the other: threads FOLDER BINARY
 *
 * The results must be the same to the last bit.
 */

#include "fmu.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { THREADS = 8, EACH = 8, STEPS = 10, RESULTS = 6, MAX_STATES = 1000 };

static Fmu fmu;

/* Instances of different models, and the numbers that they end with. */
typedef struct {
    int first;
    Component instances[EACH];
    int messages[EACH];
    double results[EACH][RESULTS];
} Work;

static int is_model_exchange(int number) {
    return number % 4 == 3;
}

/* A rotor of its own for each number: model, size, blades and flight. */
static Component created(int number, int *messages) {
    int kind = is_model_exchange(number) ? MODEL_EXCHANGE : CO_SIMULATION;
    Component instance = instantiate(&fmu, kind, messages);
    int inflow = 1 + number % 13;
    set_integer(&fmu, instance, "models.inflow", inflow);
    set_integer(&fmu, instance, "models.tipLoss", 1 + number % 3);
    set_integer(&fmu, instance, "numerics.elements", 10);
    set_integer(&fmu, instance, "geometry.numberOfBlades", 2 + number % 3);
    /* The closed form, number 1, has rigid blades only. */
    set_boolean(&fmu, instance, "flapping.enabled", inflow != 1 && number % 2);
    set_integer(&fmu, instance, "drive.mode", 1 + number / 13 % 2);
    set_real(&fmu, instance, "geometry.radius", 0.7 + 0.01 * number);
    set_real(&fmu, instance, "velocity[1]", inflow == 1 ? 0.0 : 0.1 * number);
    ok(fmu.setup_experiment(instance, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment");
    ok(fmu.enter_initialization(instance), "fmi2EnterInitializationMode");
    ok(fmu.exit_initialization(instance), "fmi2ExitInitializationMode");
    if (is_model_exchange(number)) {
        ok(fmu.enter_continuous_time(instance), "fmi2EnterContinuousTimeMode");
    }
    return instance;
}

/* One step of an instance: a step in Co-Simulation, derivatives in Model Exchange. */
static void advance(Component instance, int number, int step) {
    set_real(&fmu, instance, "collective", 0.1 + 0.005 * step);
    if (is_model_exchange(number)) {
        double rates[MAX_STATES];
        ok(fmu.get_derivatives(instance, rates, states(&fmu)), "fmi2GetDerivatives");
    } else {
        ok(fmu.do_step(instance, 0.005 * step, 0.005, 1), "fmi2DoStep");
    }
}

/* All instances of a thread, step by step side by side. */
static void *work(void *argument) {
    Work *work = argument;
    for (int i = 0; i < EACH; ++i) {
        work->instances[i] = created(work->first + i, &work->messages[i]);
    }
    for (int step = 0; step < STEPS; ++step) {
        for (int i = 0; i < EACH; ++i) {
            advance(work->instances[i], work->first + i, step);
        }
    }
    const char *names[RESULTS] = {"thrust", "torque", "force[1]", "moment[2]", "azimuth", "coning"};
    Reference places[RESULTS];
    for (int i = 0; i < RESULTS; ++i) {
        places[i] = reference(&fmu, names[i]);
    }
    for (int i = 0; i < EACH; ++i) {
        ok(fmu.get_real(work->instances[i], places, RESULTS, work->results[i]), "fmi2GetReal");
        fmu.free_instance(work->instances[i]);
    }
    return NULL;
}

int main(int count, char **arguments) {
    static Work together[THREADS], alone[THREADS];
    pthread_t threads[THREADS];
    if (count != 3) {
        fail("threads FOLDER BINARY");
    }
    load(&fmu, arguments[1], arguments[2]);
    for (int i = 0; i < THREADS; ++i) {
        together[i].first = alone[i].first = i * EACH;
        if (pthread_create(&threads[i], NULL, work, &together[i]) != 0) {
            fail("a thread cannot be created");
        }
    }
    for (int i = 0; i < THREADS; ++i) {
        pthread_join(threads[i], NULL);
    }
    int different = 0;
    for (int i = 0; i < THREADS; ++i) {
        work(&alone[i]);
        for (int j = 0; j < EACH; ++j) {
            if (memcmp(together[i].results[j], alone[i].results[j], sizeof alone[i].results[j])) {
                fprintf(stderr, "instance %d differs\n", i * EACH + j);
                return 1;
            }
            /* Thrusts of different rotors are different. */
            different += alone[i].results[j][0] != alone[0].results[0][0];
        }
    }
    unload(&fmu);
    printf("%d instances in %d threads: the same bits as one after the other\n", THREADS * EACH,
           THREADS);
    if (different != THREADS * EACH - 1) {
        fail("the rotors are not different");
    }
    return 0;
}

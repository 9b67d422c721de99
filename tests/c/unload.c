/* Loads, runs and unloads the FMU again and again: unload CYCLES FOLDER BINARY
 *
 * The results must be the same each time, and the memory of the process must not grow after the
 * first tenth of the cycles.
 */

#define _DEFAULT_SOURCE

#include "fmu.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

/* The memory that the process may take more between the first tenth of the cycles and the end.
 * A leak of one byte in five cycles is below it, one of 150 bytes in each of 1,800 is not. */
enum { ALLOWED_KB = 256 };

/* The most memory that the process has had, in kB. */
static long peak(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return usage.ru_maxrss / 1024;
#else
    return usage.ru_maxrss;
#endif
}

/* A flight with an error, a state through bytes and a step back. */
static void fly(const Fmu *fmu, double results[2]) {
    int messages = 0;
    Component instance = instantiate(fmu, CO_SIMULATION, &messages);
    set_real(fmu, instance, "collective", 0.14);
    ok(fmu->setup_experiment(instance, 0, 0.0, 0.0, 0, 0.0), "fmi2SetupExperiment");
    ok(fmu->enter_initialization(instance), "fmi2EnterInitializationMode");
    ok(fmu->exit_initialization(instance), "fmi2ExitInitializationMode");
    ok(fmu->do_step(instance, 0.0, 0.01, 1), "fmi2DoStep");
    if (fmu->do_step(instance, 0.0, 0.01, 1) != ERROR || messages != 1) {
        fail("a step from the wrong time is no error with a message");
    }
    void *state = NULL;
    size_t size = 0;
    ok(fmu->get_state(instance, &state), "fmi2GetFMUstate");
    ok(fmu->serialized_size(instance, state, &size), "fmi2SerializedFMUstateSize");
    char *bytes = malloc(size);
    if (!bytes) {
        fail("there is no memory for the importer");
    }
    ok(fmu->serialize(instance, state, bytes, size), "fmi2SerializeFMUstate");
    ok(fmu->free_state(instance, &state), "fmi2FreeFMUstate");
    ok(fmu->do_step(instance, 0.01, 0.01, 1), "fmi2DoStep");
    ok(fmu->deserialize(instance, bytes, size, &state), "fmi2DeSerializeFMUstate");
    free(bytes);
    ok(fmu->set_state(instance, state), "fmi2SetFMUstate");
    ok(fmu->free_state(instance, &state), "fmi2FreeFMUstate");
    ok(fmu->do_step(instance, 0.01, 0.02, 1), "fmi2DoStep");
    Reference places[2] = {reference(fmu, "thrust"), reference(fmu, "torque")};
    ok(fmu->get_real(instance, places, 2, results), "fmi2GetReal");
    ok(fmu->terminate(instance), "fmi2Terminate");
    fmu->free_instance(instance);
}

int main(int count, char **arguments) {
    if (count != 4) {
        fail("unload CYCLES FOLDER BINARY");
    }
    long cycles = strtol(arguments[1], NULL, 10), begin = 0;
    double first[2];
    for (long i = 0; i < cycles; ++i) {
        Fmu fmu;
        double results[2];
        load(&fmu, arguments[2], arguments[3]);
        fly(&fmu, results);
        unload(&fmu);
        if (i == 0) {
            memcpy(first, results, sizeof first);
        } else if (memcmp(first, results, sizeof first) != 0) {
            fail("the results change from one load to the next");
        }
        if (i == cycles / 10) {
            begin = peak();
        }
    }
    long end = peak();
    printf("%ld cycles, thrust %.3f N, memory from %ld to %ld kB\n", cycles, first[0], begin, end);
    /* Few cycles say nothing about growth, and checking tools have memory of their own. */
    if (cycles >= 100 && end - begin > ALLOWED_KB) {
        fail("the memory grows");
    }
    return 0;
}

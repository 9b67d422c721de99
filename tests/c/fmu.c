#define _DEFAULT_SOURCE /* RTLD_NOLOAD */

#include "fmu.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fail(const char *sentence) {
    fprintf(stderr, "%s\n", sentence);
    exit(1);
}

void ok(Status status, const char *call) {
    if (status != OK) {
        fail(call);
    }
}

/* Memory, or the end. */
static void *room(size_t size) {
    void *memory = malloc(size);
    if (!memory) {
        fail("there is no memory for the importer");
    }
    return memory;
}

/* prefix, folder and name in one string. */
static char *joined(const char *prefix, const char *folder, const char *name) {
    size_t size = strlen(prefix) + strlen(folder) + strlen(name) + 2;
    char *text = room(size);
    snprintf(text, size, "%s%s/%s", prefix, folder, name);
    return text;
}

static char *text_of(const char *folder, const char *name) {
    char *path = joined("", folder, name);
    FILE *file = fopen(path, "rb");
    free(path);
    if (!file) {
        fail("modelDescription.xml cannot be opened");
    }
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    char *text = room((size_t)size + 1);
    if (fread(text, 1, (size_t)size, file) != (size_t)size) {
        fail("modelDescription.xml cannot be read");
    }
    text[size] = 0;
    fclose(file);
    return text;
}

/* A copy of the value of an attribute, which begins at or after a place in the text. */
static char *attribute(const char *text, const char *name) {
    const char *begin = strstr(text, name);
    if (!begin) {
        fail(name);
    }
    begin += strlen(name);
    size_t length = strcspn(begin, "\"");
    char *value = room(length + 1);
    memcpy(value, begin, length);
    value[length] = 0;
    return value;
}

static void *function(void *library, const char *name) {
    void *address = dlsym(library, name);
    if (!address) {
        fail(name);
    }
    return address;
}

void load(Fmu *fmu, const char *folder, const char *binary) {
    fmu->description = text_of(folder, "modelDescription.xml");
    fmu->guid = attribute(fmu->description, " guid=\"");
    fmu->resources = joined("file://", folder, "resources");
    fmu->binary = binary;
    fmu->library = dlopen(binary, RTLD_NOW | RTLD_LOCAL);
    if (!fmu->library) {
        fail(dlerror());
    }
    /* POSIX lets the address of a function be one of data. */
#define FIND(field, name) *(void **)&fmu->field = function(fmu->library, name)
    FIND(instantiate, "fmi2Instantiate");
    FIND(free_instance, "fmi2FreeInstance");
    FIND(setup_experiment, "fmi2SetupExperiment");
    FIND(enter_initialization, "fmi2EnterInitializationMode");
    FIND(exit_initialization, "fmi2ExitInitializationMode");
    FIND(set_real, "fmi2SetReal");
    FIND(set_integer, "fmi2SetInteger");
    FIND(set_boolean, "fmi2SetBoolean");
    FIND(get_real, "fmi2GetReal");
    FIND(do_step, "fmi2DoStep");
    FIND(get_state, "fmi2GetFMUstate");
    FIND(set_state, "fmi2SetFMUstate");
    FIND(free_state, "fmi2FreeFMUstate");
    FIND(serialized_size, "fmi2SerializedFMUstateSize");
    FIND(serialize, "fmi2SerializeFMUstate");
    FIND(deserialize, "fmi2DeSerializeFMUstate");
    FIND(enter_continuous_time, "fmi2EnterContinuousTimeMode");
    FIND(get_derivatives, "fmi2GetDerivatives");
    FIND(terminate, "fmi2Terminate");
#undef FIND
}

void unload(Fmu *fmu) {
    if (dlclose(fmu->library) != 0) {
        fail(dlerror());
    }
    if (dlopen(fmu->binary, RTLD_NOW | RTLD_NOLOAD)) {
        fail("the library stays loaded");
    }
    free(fmu->description);
    free(fmu->guid);
    free(fmu->resources);
}

Reference reference(const Fmu *fmu, const char *name) {
    size_t size = strlen(name) + sizeof(" name=\"\"");
    char *quoted = room(size);
    snprintf(quoted, size, " name=\"%s\"", name);
    const char *place = strstr(fmu->description, "<ModelVariables");
    place = place ? strstr(place, quoted) : NULL;
    free(quoted);
    if (!place) {
        fail(name);
    }
    char *value = attribute(place, " valueReference=\"");
    Reference reference = (Reference)strtoul(value, NULL, 10);
    free(value);
    return reference;
}

size_t states(const Fmu *fmu) {
    size_t count = 0;
    const char *place = fmu->description;
    while ((place = strstr(place, " derivative=\""))) {
        ++place;
        ++count;
    }
    return count;
}

/* Counts messages in the environment, and reads them to their end. */
static void count(void *environment, const char *instance, Status status, const char *category,
                  const char *message, ...) {
    if (strlen(instance) == 0 || strlen(category) == 0 || strlen(message) == 0 || status < OK) {
        fail("a message without a text");
    }
    ++*(int *)environment;
}

Component instantiate(const Fmu *fmu, int kind, int *messages) {
    Callbacks callbacks = {count, calloc, free, NULL, messages};
    Component instance =
        fmu->instantiate("rotor", kind, fmu->guid, fmu->resources, &callbacks, 0, 0);
    if (!instance) {
        fail("fmi2Instantiate");
    }
    return instance;
}

void set_real(const Fmu *fmu, Component instance, const char *name, double value) {
    Reference place = reference(fmu, name);
    ok(fmu->set_real(instance, &place, 1, &value), name);
}

void set_integer(const Fmu *fmu, Component instance, const char *name, int value) {
    Reference place = reference(fmu, name);
    ok(fmu->set_integer(instance, &place, 1, &value), name);
}

void set_boolean(const Fmu *fmu, Component instance, const char *name, int value) {
    Reference place = reference(fmu, name);
    ok(fmu->set_boolean(instance, &place, 1, &value), name);
}

# The front door; `make help` lists what is behind it. The build itself is CMake's (CMakePresets.json).

# Serial: each target first installs what it needs. What takes long runs in parallel by itself.
.NOTPARALLEL:
.PHONY: all demo docs test soak bench bench-record paper firmware muster package eeprom flash fuses deps help clean
.PHONY: build-bench deps-bench deps-host deps-demo deps-firmware deps-flash deps-package deps-test

PROGRAMMER ?= usbasp
PART ?= m128
SECONDS ?= 600
AVRDUDE ?= avrdude
export PROGRAMMER PORT PART AVRDUDE AVRDUDE_FLAGS

programmer_given := $(filter command environment,$(firstword $(origin PROGRAMMER)) $(firstword $(origin PORT)))
firmware_options = $(if $(F_CPU),-DMUSTER_F_CPU=$(F_CPU)) $(if $(BAUD),-DMUSTER_BAUD=$(BAUD))

all: muster firmware

demo: deps-demo muster firmware
	build/muster sim scenarios/paper-sim-leader-fault.yaml

test: deps-test firmware
	cmake --preset host -DUNITY_ROOT="$(UNITY_ROOT)"
	cmake --build --preset host
	cmake --preset asan -DUNITY_ROOT="$(UNITY_ROOT)"
	cmake --build --preset asan
	cmake --preset fuzz
	cmake --build --preset fuzz
	ctest --preset asan --parallel $$(nproc) --label-regex 'unit|avr|native|mocap|arena|service|view|recording'
	ctest --preset host --parallel $$(nproc)

# Robots and a server in real time, and a fault at random every few seconds.
soak: deps-test firmware
	cmake --preset asan -DUNITY_ROOT="$(UNITY_ROOT)"
	cmake --build --preset asan --target arena_soak
	build/asan/tests/arena/arena_soak $(SECONDS)

bench: deps-bench build-bench
	build/tests/bench/bench measure build/bench.json

# Accepts the figures as they now are.
bench-record: build-bench
	build/tests/bench/bench accept tests/bench/record.txt

build-bench: deps-test firmware
	cmake --preset host -DUNITY_ROOT="$(UNITY_ROOT)"
	cmake --build --preset host --target bench

# What comes out belongs to the documentation, so a change of behaviour shows in its diff.
paper: muster firmware
	build/muster paper
	cp build/paper/paper.md docs/paper.md

# The pictures in the README, from the run that `make demo` shows.
docs: deps-demo muster firmware
	build/muster sim --quiet --out build/docs scenarios/paper-sim-leader-fault.yaml
	build/muster video --out build/docs/leader-fault.svg build/docs
	mv build/docs/routes.svg build/docs/leader-fault-routes.svg
	@cd docs/images && for picture in leader-fault.svg leader-fault-routes.svg; do \
	    if cmp -s ../../build/docs/$$picture $$picture; then \
	        echo "docs/images/$$picture is as it was"; \
	    else \
	        cp ../../build/docs/$$picture $$picture; echo "docs/images/$$picture has changed"; \
	    fi; \
	done

firmware: deps-firmware
	cmake --preset firmware $(firmware_options)
	cmake --build --preset firmware

muster: deps-host build/CMakeCache.txt
	cmake --build --preset host --target muster

# The first configuring, for those who want muster and no tests; `make test` adds them.
build/CMakeCache.txt:
	cmake --preset host -DBUILD_TESTING=OFF

# Configured once more, for what of its tools was missing before.
package: deps-package muster firmware
	cmake build
	cmake --build --preset host --target man
	cpack --config build/CPackConfig.cmake

# Without a programmer only a file, for whoever has another way to write it.
eeprom: $(if $(programmer_given),deps-flash) muster
	$(if $(programmer_given),firmware/program.sh eeprom "$(ID)", \
	    build/muster eeprom --id "$(ID)" --out build/robot-$(ID).eep)

flash: deps-flash muster firmware
	firmware/program.sh flash "$(ID)"

fuses: deps-flash
	firmware/program.sh fuses

deps: deps-test deps-flash deps-package deps-bench

deps-test:
	@cmake/install-deps.sh test
	@$(if $(UNITY_ROOT),:,cmake/fetch-unity.sh build/_deps/unity)
	@tests/rfcomm/get-kernel.sh build/_deps/rfcomm
	@tests/mocap/get-decoders.sh build/_deps/decoders
	@tests/recording/get-readers.sh build/_deps/readers
	@tests/view/get-browser-tools.sh build/_deps/view

deps-host deps-demo deps-firmware deps-flash deps-package deps-bench: deps-%:
	@cmake/install-deps.sh $*

help:
	@echo 'make           build/muster and the robots'\'' image in build/firmware/'
	@echo 'make demo      four simulated robots form up, lose their leader and recover'
	@echo 'make test      every test'
	@echo 'make soak      SECONDS=600 of random faults on a server and virtual robots, in real time'
	@echo 'make bench     every figure of speed and size beside plain baselines: build/bench.json'
	@echo 'make paper     every figure of the paper again: build/paper/report.html, docs/paper.md'
	@echo 'make docs      the pictures in the README again, from a run of the robots'\'' image'
	@echo 'make firmware  the robots'\'' image; F_CPU=14745600 and BAUD=57600 change it and are kept'
	@echo 'make fuses     PROGRAMMER=usbasp PORT=... PART=m128: set up the fuses of a new ATmega128'
	@echo 'make flash     ID=3 PROGRAMMER=usbasp PORT=...: image, boot loader and id into a robot'
	@echo 'make eeprom    ID=3: only the EEPROM of a robot, build/robot-3.eep; with PROGRAMMER= into it'
	@echo 'make package   a Debian package of all that runs on the host: build/package/muster_*.deb'
	@echo 'make deps      only install what all of these need (Debian 12)'
	@echo 'make clean     remove build/'

clean:
	rm -rf build

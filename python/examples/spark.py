"""Reconstructs a table of crashes on Spark: Parquet in, Parquet out, a row of results for each row.

On this machine, with a process for each core:

    python spark.py crashes.parquet results --template template.toml --samples 1000

On a cluster, whose workers all see the two paths and have the package ``pydeltav``:

    spark-submit --master spark://HOST:7077 spark.py crashes.parquet results --template template.toml

The columns of the table are those of ``deltav table``: keys of the case file, nested or flat with their unit, and
any others, which are carried over. The results have the same bits as those of one process, whatever the number of
tasks and machines. Spark does not keep the order of rows, so the table should have a column that names the crash.
A row that is wrong or has no answer says so in the column ``error``.
"""

import argparse
import math
import pathlib
import sys
import time
from collections.abc import Iterator
from typing import Any

import pydeltav
import pyarrow as pa
from pyspark.errors import AnalysisException
from pyspark.sql import DataFrame, SparkSession

JOBS = ("reconstruct", "impact", "crush", "estimate")


def rows_of_a_task(job: str, samples: int | None) -> int:
    """Rows that take one core ten seconds or so.

    Spark needs some tenths of a second to start a task and to commit what it wrote, so a task of ten seconds loses
    a few percent. If a machine is lost, its unfinished tasks are computed again, and at the end of the job cores
    wait for the last task: both cost ten seconds then, and not minutes.
    """
    if job == "estimate":
        return 10
    return 200_000 if samples is None else max(20_000_000 // samples, 1)


def number_of_tasks(rows: int, rows_of_task: int, cores: int) -> int:
    """At least three for each core: where some rows take longer than others, the cores still end together."""
    return max(math.ceil(rows / rows_of_task), 3 * cores)


def results_of(batch: pa.RecordBatch, names: list[str], job: str, options: dict[str, Any]) -> pa.Table:
    """The results of some rows, beside the columns that are carried over."""
    table = getattr(pydeltav, f"{job}_table")
    return pa.table(table(batch.rename_columns(names), **options))


def solved(spark: SparkSession, cases: DataFrame, tasks: int, job: str, options: dict[str, Any]) -> DataFrame:
    """The results of all rows, computed when they are written.

    ``repartition`` spreads the rows evenly, even those of a file that is one row group and would be one task. Spark
    sorts them before it deals them out, so that a task that is computed again has the same rows.
    """
    names = cases.columns
    # mapInArrow takes a dot for the field of a struct: inside Spark the columns have names without.
    numbered = cases.toDF(*(f"column{place}" for place in range(len(names))))
    # Without rows, the engine says what columns it gives, or what is wrong with the template and the columns.
    empty = pa.RecordBatch.from_pylist([], schema=numbered.limit(0).toArrow().schema)
    schema = spark.createDataFrame(results_of(empty, names, job, options)).schema

    def solve(batches: Iterator[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
        """Spark runs it in the Python processes of its workers."""
        for batch in batches:
            yield from results_of(batch, names, job, options).to_batches()

    return numbered.repartition(tasks).mapInArrow(solve, schema)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", help="the table: a Parquet file, or a folder of them")
    parser.add_argument("results", help="the folder of the results, which Spark makes")
    parser.add_argument("--template", type=pathlib.Path, help="a part of a case file: what all rows share")
    parser.add_argument("--job", choices=JOBS, default=JOBS[0], help="what is made of each row (default: %(default)s)")
    parser.add_argument("--samples", type=int, help="samples of each row for its 95 %% intervals; default: no intervals")
    seed = "seed of every row that has none in a column seed (default: %(default)s)"
    parser.add_argument("--seed", type=int, default=1, help=seed)
    tasks = "pieces into which the table is divided (default: of about ten seconds each, and at least three for each core)"
    parser.add_argument("--tasks", type=int, help=tasks)
    given = parser.parse_args()
    if given.samples is not None and given.job not in ("reconstruct", "impact"):
        parser.error(f"--samples is for the jobs reconstruct and impact, and the job is {given.job}: leave it out")
    if given.tasks is not None and given.tasks < 1:
        parser.error(f"--tasks {given.tasks}: give 1 or more")
    return given


def main() -> int:
    given = arguments()
    # Spark gives each core a task, so that the engine has one thread.
    options: dict[str, Any] = {"threads": 1}
    try:
        if given.template is not None:
            # The text, as the workers may not see the file.
            options["template"] = given.template.read_text(encoding="utf-8")
    except OSError as error:
        sys.exit(f"error: cannot read the template: {error}")
    if given.job != "crush":
        options["seed"] = given.seed
    if given.samples is not None:
        options["samples"] = given.samples
    spark = SparkSession.builder.appName("deltav").getOrCreate()
    try:
        cases = spark.read.parquet(given.cases)
        rows = cases.count()
        cores = spark.sparkContext.defaultParallelism
        tasks = given.tasks or number_of_tasks(rows, rows_of_a_task(given.job, given.samples), cores)
        began = time.monotonic()
        # Numbers hardly ever repeat, and a dictionary of them would take a third as long as the samples.
        writer = solved(spark, cases, tasks, given.job, options).write.option("parquet.enable.dictionary", "false")
        writer.parquet(given.results)
        passed = time.monotonic() - began
        written = spark.read.parquet(given.results)
        found = written.count()
        failed = written.where("error is not null").count()
    except (AnalysisException, ValueError) as error:
        sys.exit(f"error: {error}")
    finally:
        spark.stop()
    print(f"{found} rows, {failed} of them without an answer, in {tasks} tasks and {passed:.1f} s: {given.results}")
    if found != rows:
        sys.exit(f"error: the table has {rows} rows and the results have {found}: do not use them")
    return 0


if __name__ == "__main__":
    sys.exit(main())

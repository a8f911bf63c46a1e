FROM python:3.11-slim

# One BLAS thread per process: the work is spread over processes.
ENV OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 PYTHONUNBUFFERED=1

WORKDIR /srv/hardlanding
COPY requirements.lock ./
RUN pip install --no-cache-dir --require-hashes -r requirements.lock
COPY pyproject.toml README.md alembic.ini ./
COPY solver solver
COPY app app
COPY worker worker
COPY migrations migrations
COPY examples examples
RUN pip install --no-cache-dir --no-deps --no-build-isolation -e . \
    && useradd --system hardlanding \
    && mkdir -p /var/lib/hardlanding \
    && chown -R hardlanding /var/lib/hardlanding /srv/hardlanding
# The compiled routines are cached beside their sources, which is why these belong to the user.
USER hardlanding
VOLUME /var/lib/hardlanding
EXPOSE 8000
CMD ["hardlanding", "serve", "--host", "0.0.0.0"]

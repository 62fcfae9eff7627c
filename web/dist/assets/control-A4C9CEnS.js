import{S as e,a as t,d as n,h as r,i,n as a,o,p as s,r as c,t as l,u,w as d,x as f}from"./index-Qc_W3yad.js";import{n as p,r as m,t as h}from"./hold-uLSkGs3s.js";import{t as g}from"./tab-lKZc--Iv.js";import"./curves-Czq8Aw4T.js";import{t as _}from"./axis-picker-BWtEly2K.js";var v=class extends g{static properties={...g.properties,axis:{type:String}};watches=[`status`];#e=null;static styles=[s,p,d`
      .panel {
        display: flex;
        flex-direction: column;
        gap: 8px;
        height: 100%;
      }
      .panel.error {
        border-color: var(--error);
      }
      .name {
        font-size: 16px;
        font-weight: 700;
      }
      .position {
        font-size: 30px;
        font-weight: 600;
        line-height: 1.1;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      .unit {
        color: var(--muted);
        font-size: 12px;
        font-weight: 400;
      }
      dl {
        display: grid;
        grid-template-columns: repeat(2, auto 1fr);
        gap: 2px 8px;
        margin: 0;
      }
      dt {
        color: var(--muted);
        font-size: 12px;
        line-height: 20px;
      }
      dd {
        margin: 0;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      .lamps {
        display: flex;
        flex-wrap: wrap;
        gap: 4px 14px;
      }
      .error-line {
        display: flex;
        align-items: center;
        gap: 8px;
        min-height: 26px;
        font-size: 13px;
      }
      .jog {
        display: grid;
        grid-template-columns: 1fr auto 1fr;
        gap: 8px;
      }
      .jog button {
        min-height: 38px;
      }
      details {
        font-size: 13px;
      }
      summary {
        color: var(--muted);
        font-size: 12px;
        cursor: pointer;
      }
      ul {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(140px, 1fr));
        gap: 1px 10px;
        margin: 6px 0 0;
        padding: 0;
        list-style: none;
      }
      .set {
        display: grid;
        grid-template-columns: 1fr auto;
        gap: 6px;
        margin-top: 6px;
        align-items: end;
      }
    `];render(){let t=this.live.status?.axes[this.axis];if(!t)return e`<section class="panel"><span class="name">${this.axis}</span> –</section>`;let n=e=>this.catalog.actions.includes(e),r=this.axis;return e`
      <section class="panel ${t.error?`error`:``}" aria-label="Axis ${r}">
        <div class="row">
          <span class="name">${/^\d+$/.test(r)?`Axis ${r}`:r}</span>
          <span class="badge ${l(t)}" data-role="state">${t.state}</span>
          ${t.loop_state&&t.loop_state!==`NA`?e`<span class="badge" title="StepNLoop">${t.loop_state}</span>`:f}
          <span class="grow"></span>
          ${n(`power`)&&t.enabled!==null?e`<button class="small" aria-pressed=${t.enabled} ?disabled=${!this.usable}
                @click=${()=>this.#a({do:`power`,axis:r,on:!t.enabled})}>
                motor ${t.enabled?`on`:`off`}
              </button>`:f}
        </div>
        <div class="position" data-role="position">
          ${c(t.position)} <span class="unit">${this.catalog.units.position}</span>
        </div>
        ${this.#t(t)}
        <div class="lamps">
          ${h(`−L`,t.negative_limit,`negative limit`,!0)}
          ${h(`Home`,t.home,`home switch`)}
          ${h(`+L`,t.positive_limit,`positive limit`,!0)}
          ${h(`Z`,t.index,`encoder index`)}
        </div>
        <div class="error-line">
          ${t.error?e`<span class="grow"><strong class="error-text">⚠ ${t.error}</strong>
                ${this.catalog.language===`a-script`?e`<span class="muted">Moves are refused until it is cleared.</span>`:f}</span>`:e`<span class="muted grow">no error</span>`}
          ${n(`clear_error`)?e`<button class="small" ?disabled=${!this.usable||!t.error}
                @click=${()=>this.#a({do:`clear_error`,axis:r})}>Clear</button>`:f}
        </div>
        <div class="jog">
          <pt-hold .disabled=${!this.usable} .label=${`Jog ${r} in negative direction while pressed`}
            @begin=${()=>this.#o(-1)} @end=${()=>this.#e?.end()}>◀ −</pt-hold>
          <button ?disabled=${!this.reachable} aria-label="Stop ${r}" title="Stop with deceleration"
            @click=${this.#s}>■</button>
          <pt-hold .disabled=${!this.usable} .label=${`Jog ${r} in positive direction while pressed`}
            @begin=${()=>this.#o(1)} @end=${()=>this.#e?.end()}>+ ▶</pt-hold>
        </div>
        ${this.#n(t)} ${this.#r(n)}
      </section>
    `}#t(t){let{units:n}=this.catalog,r=[[`Speed`,t.speed,n.speed],[`Target`,t.target,n.position],[`Encoder`,t.encoder,n.encoder],[`Delta`,t.delta,n.encoder],[`Load`,t.load,``]].filter(([e,t])=>t!==null||e===`Target`||e===`Encoder`);return e`
      <dl>
        ${r.map(([t,n,r])=>e`<dt>${t}</dt><dd data-role=${t.toLowerCase()}>${c(n)}
          ${n===null||r===``?f:e`<span class="unit">${r}</span>`}</dd>`)}
      </dl>
    `}#n(t){return this.catalog.status_bits.length===0?f:e`
      <details>
        <summary>Status bits · ${t.flags.join(`, `)||`none set`}</summary>
        <ul>
          ${this.catalog.status_bits.map(({name:n,text:r,kind:i})=>e`<li>${h(n,t.flags.includes(n),r||n,i===`error`)}</li>`)}
        </ul>
      </details>
    `}#r(t){let n=[{action:`set_position`,label:`Position counter`,reset:`RP`},{action:`set_encoder`,label:`Encoder counter`,reset:`RE`}].filter(({action:e})=>t(e));return n.length===0?f:e`
      <details>
        <summary>Set counters</summary>
        ${n.map(({action:t,label:n})=>e`
            <form class="set" @submit=${e=>this.#i(e,t)}>
              <label>${n}<input name="value" class="number" type="text" inputmode="numeric" value="0" autocomplete="off" /></label>
              <button ?disabled=${!this.usable}>Set</button>
            </form>
          `)}
      </details>
    `}#i(e,t){e.preventDefault();let r=o(String(new FormData(e.target).get(`value`)));r===null?n(`A counter takes a whole number.`,`error`):this.#a({do:t,axis:this.axis,value:r})}#a(e){return u(()=>this.api.act(this.device.name,e))}#o(e){this.#e??=new m(this.api,this.live,this.axis),this.#e.begin(e)}#s(){this.locked?u(()=>this.api.stop(this.device.name)):this.#a({do:`stop`,axis:this.axis})}};customElements.define(`pt-axis`,v);var y=class extends g{static properties={...g.properties,axis:{state:!0},mode:{state:!0}};static styles=[s,d`
      .panel {
        height: 100%;
      }
      .about {
        min-height: 2.8em;
        font-size: 13px;
        color: var(--muted);
      }
    `];willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.catalog.axes[0]??``,this.mode=this.catalog.homing[0]?.id??0)}render(){let{homing:t,axes:n}=this.catalog,r=t.find(({id:e})=>e===this.mode);return e`
      <section class="panel stack" aria-label="Home">
        <div class="row"><h2 class="grow">Home</h2>
          ${_(n,this.axis,`home-axis`,e=>this.axis=e)}
        </div>
        <label>Mode
          <select @change=${e=>this.mode=Number(e.target.value)}>
            ${t.map(({id:t,name:n})=>e`<option value=${t} ?selected=${t===this.mode}>${t} · ${n}</option>`)}
          </select>
        </label>
        <p class="about">${r?.text}${r?.section?e` <span>(manual, ${r.section})</span>`:f}</p>
        <div class="row">
          ${[`-`,`+`].map(t=>r?.directions.includes(t)?e`<button class="grow" ?disabled=${!this.usable}
                  aria-label="Home ${this.axis} in ${t===`+`?`positive`:`negative`} direction"
                  @click=${()=>this.#e(t===`+`?1:-1)}>
                  ${t===`-`?`◀ Home −`:`Home + ▶`}
                </button>`:f)}
        </div>
      </section>
    `}#e(e){let{axis:t,mode:n}=this;u(()=>this.api.act(this.device.name,{do:`home`,axis:t,mode:n,direction:e}))}};customElements.define(`pt-homing`,y);var b=class extends g{static properties={...g.properties,chosen:{state:!0},relative:{state:!0}};watches=[`status`];static styles=[s,d`
      .panel {
        height: 100%;
      }
      .targets {
        display: grid;
        grid-template-columns: auto minmax(0, 1fr) auto;
        gap: 6px 10px;
        align-items: center;
      }
      .mode {
        display: inline-flex;
      }
      .mode button:first-child {
        border-radius: var(--radius) 0 0 var(--radius);
      }
      .mode button:last-child {
        margin-left: -1px;
        border-radius: 0 var(--radius) var(--radius) 0;
      }
      .head {
        justify-content: space-between;
      }
    `];constructor(){super(),this.chosen=new Set,this.relative=!1}willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.chosen=new Set(this.catalog.axes.slice(0,1)))}get#e(){let e=this.live.status?.absolute;return typeof e==`boolean`?!e:this.relative}render(){let{axes:t}=this.catalog,n=this.#e,r=this.chosen.size>1;return e`
      <form class="panel stack" @submit=${this.#r}>
        <div class="row head">
          <h2>Move</h2>
          <div class="mode" role="group" aria-label="Move mode">
            <button type="button" class="small" aria-pressed=${!n} ?disabled=${!this.usable}
              title="Targets are positions" @click=${()=>this.#n(!1)}>ABS</button>
            <button type="button" class="small" aria-pressed=${n} ?disabled=${!this.usable}
              title="Targets are distances" @click=${()=>this.#n(!0)}>INC</button>
          </div>
        </div>
        <div class="targets">
          ${t.map(r=>e`
              <label class="line">
                ${t.length>1?e`<input type="checkbox" aria-label="Move axis ${r}" .checked=${this.chosen.has(r)}
                      @change=${e=>this.#t(r,e.target.checked)} />`:f}
                <strong>${r}</strong>
              </label>
              <input name=${r} class="number" type="text" inputmode="numeric" value="0" autocomplete="off"
                aria-label="${n?`Distance`:`Target`} of axis ${r} in ${this.catalog.units.position}" />
              <span class="muted">${this.catalog.units.position}</span>
            `)}
        </div>
        <div class="row">
          <button class="primary grow" ?disabled=${!this.usable||this.chosen.size===0}>
            ${r?`Move ${[...this.chosen].join(`, `)} together`:n?`Move by`:`Move to`}
          </button>
          <button type="button" ?disabled=${!this.usable||this.chosen.size===0} title="Move to position 0"
            @click=${this.#i}>Return to 0</button>
        </div>
        <div class="row">
          <button type="button" class="grow" ?disabled=${!this.reachable} title="With deceleration"
            @click=${()=>u(()=>this.api.stop(this.device.name))}>Stop all axes</button>
          ${this.catalog.actions.includes(`abort`)?e`<button type="button" class="danger grow" ?disabled=${!this.usable} title="At once, without deceleration"
                @click=${()=>u(()=>this.api.act(this.device.name,{do:`abort`}))}>Abort</button>`:f}
        </div>
      </form>
    `}#t(e,t){this.chosen=new Set(this.catalog.axes.filter(n=>n===e?t:this.chosen.has(n)))}#n(e){this.relative=e,this.catalog.actions.includes(`set_mode`)&&u(()=>this.api.act(this.device.name,{do:`set_mode`,absolute:!e}))}#r(e){e.preventDefault();let t=new FormData(e.target),r={};for(let e of this.chosen){let i=o(String(t.get(e)));if(i===null){n(`The target of axis ${e} is not a whole number.`,`error`);return}r[e]=i}this.#a(r,this.#e)}#i(){this.#a(Object.fromEntries([...this.chosen].map(e=>[e,0])),!1)}#a(e,t){u(()=>this.api.act(this.device.name,{do:`move`,targets:e,relative:t}))}};customElements.define(`pt-moves`,b);var x=class extends g{static properties={...g.properties,axis:{state:!0}};static styles=[s,d`
      .panel {
        height: 100%;
      }
      .fields {
        display: flex;
        flex-wrap: wrap;
        gap: 8px;
      }
      .fields label {
        flex: 1;
        min-width: 60px;
      }
      .fields button {
        align-self: flex-end;
        min-width: 96px;
      }
    `];willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.catalog.axes[0]??``)}render(){let{actions:t,axes:n,parameters:r,speed_windows:i,units:a}=this.catalog,o=r.find(({role:e})=>e===`acceleration`),s=r.find(({role:e,axis:t})=>e===`speed_window`&&t===this.axis)?.id;return e`
      <div class="panel stack">
        <div class="row"><h2 class="grow">On the fly</h2>
          ${_(n,this.axis,`fly-axis`,e=>this.axis=e)}
        </div>
        ${s===void 0?f:e`<form class="fields" @submit=${e=>this.#e(e,s)}>
              <label title="Both speeds have to lie in it; it can be set while the motor stands">Speed window (pps)
                <select name="window">
                  <option value="0">0 · no changes</option>
                  ${i.map(({number:t,from_pps:n,to_pps:r})=>e`
                    <option value=${t}>${t} · ${c(n)} to ${c(r)}</option>`)}
                </select>
              </label>
              <button ?disabled=${!this.usable}>Set ${s}</button>
            </form>`}
        ${t.includes(`change_speed`)?e`<form class="fields" @submit=${this.#t}>
              <label>Speed (${a.speed})<input name="speed" class="number" type="text" inputmode="numeric" value="1000" /></label>
              <label title=${o?`${o.name}; empty: as it is`:`empty: as it is`}>Accel${o?.unit?` (${o.unit})`:``}<input name="acceleration" class="number" type="text" inputmode="numeric" /></label>
              <button ?disabled=${!this.usable}>Set speed</button>
            </form>`:f}
        ${t.includes(`change_target`)?e`<form class="fields" @submit=${this.#n}>
              <label>Target (${a.position})<input name="target" class="number" type="text" inputmode="numeric" value="1000" /></label>
              <button ?disabled=${!this.usable}>Set target</button>
            </form>`:f}
      </div>
    `}#e(e,t){e.preventDefault();let n=Number(new FormData(e.target).get(`window`));u(()=>this.api.setParameter(this.device.name,t,n),`${t} is ${n}`)}#t(e){e.preventDefault();let t=new FormData(e.target),r={};for(let e of[`speed`,`acceleration`]){let i=String(t.get(e)??``).trim();if(i===``&&e!==`speed`)continue;let a=o(i);if(a===null){n(`“${i}” is not a whole number.`,`error`);return}r[e]=a}let{axis:i}=this;u(()=>this.api.act(this.device.name,{do:`change_speed`,axis:i,speed:r.speed,...r}))}#n(e){e.preventDefault();let t=o(String(new FormData(e.target).get(`target`)));t===null?n(`A target is a whole number.`,`error`):u(()=>this.api.act(this.device.name,{do:`change_target`,axis:this.axis,target:t}))}};customElements.define(`pt-on-the-fly`,x);var S=[`high_speed`,`low_speed`,`acceleration`,`deceleration`];function C(e){return e.filter(({role:e,readable:t,writable:n})=>t&&n&&S.includes(e))}var w=class extends g{static properties={...g.properties,values:{state:!0},axis:{state:!0}};#e=!1;static styles=[s,d`
      .panel {
        height: 100%;
      }
      .fields {
        display: grid;
        grid-template-columns: repeat(auto-fit, minmax(96px, 1fr));
        gap: 8px;
      }
      select {
        width: auto;
      }
    `];constructor(){super(),this.values={},this.axis=null}willUpdate(e){super.willUpdate(e),e.has(`catalog`)&&(this.axis=this.#t()[0]??null)}updated(e){e.has(`active`)&&this.active&&(this.#e=!1),!this.#e&&this.reachable&&this.active&&(this.#e=!0,this.#n())}#t(){return[...new Set(C(this.catalog.parameters).map(({axis:e})=>e))]}async#n(){for(let{id:e}of C(this.catalog.parameters))try{let t=await this.api.parameter(this.device.name,e);this.values={...this.values,[e]:t}}catch(t){t.status!==0&&n(`${e}: ${r(t)}`,`error`),this.#e=t.status!==0;return}}render(){let t=this.#t();if(t.length===0)return f;let n=C(this.catalog.parameters).filter(({axis:e})=>e===this.axis);return e`
      <form class="panel stack" @submit=${this.#a}>
        <div class="row"><h2 class="grow">Speeds and ramps</h2>
          ${t.length>1?e`<select aria-label="Whose" @change=${this.#i}>
                ${t.map(t=>e`<option value=${t??``} ?selected=${t===this.axis}>
                  ${t===null?`all axes`:`axis ${t}`}</option>`)}
              </select>`:f}
        </div>
        <div class="fields">
          ${n.map(t=>e`
            <label title="${t.text} (${t.symbol}, manual ${t.section})">
              ${t.name}${t.unit?` (${t.unit})`:``}
              <input name=${t.id} class="number" type="text" inputmode="decimal" autocomplete="off"
                .value=${this.#r(t)} />
            </label>`)}
        </div>
        <div class="row"><span class="grow"></span>
          <button type="button" ?disabled=${!this.reachable} @click=${()=>this.#n()}>Read</button>
          <button ?disabled=${!this.usable}>Set</button>
        </div>
      </form>
    `}#r(e){let t=this.values[e.id];return t===void 0?``:typeof t==`number`?i(t,e.decimals).replace(`−`,`-`):t}#i(e){this.axis=e.target.value||null}async#a(e){e.preventDefault();let r=new FormData(e.target);for(let e of C(this.catalog.parameters).filter(({axis:e})=>e===this.axis)){let i=String(r.get(e.id)).trim();if(i===``||i===this.#r(e))continue;let a=t(i);if(a===null){n(`${e.name}: “${i}” is not a number.`,`error`);return}if(!await u(()=>this.api.setParameter(this.device.name,e.id,a)))return;this.values={...this.values,[e.id]:a}}}};customElements.define(`pt-ramps`,w);var T=class extends g{watches=[`status`];static styles=[s,d`
      .grid {
        display: grid;
        grid-template-columns: repeat(var(--columns), minmax(0, 1fr));
        gap: var(--gap);
        --columns: 4;
      }
      .grid > * {
        min-width: 0;
      }
      pt-curves {
        grid-column: 1 / -1;
      }
      /* What the last row leaves free is the chart's, if that is two columns. */
      @media (min-width: 1151px) {
        .after-1-of-4 {
          grid-column: 2 / -1;
        }
        .after-2-of-4 {
          grid-column: 3 / -1;
        }
      }
      @media (min-width: 861px) and (max-width: 1150px) {
        .grid {
          --columns: 3;
        }
        .after-1-of-3 {
          grid-column: 2 / -1;
        }
      }
      @media (max-width: 860px) {
        .grid {
          --columns: 2;
        }
      }
      @media (max-width: 600px) {
        .grid {
          --columns: 1;
        }
      }
      .summary {
        min-height: 24px;
        margin-bottom: 8px;
        font-size: 13px;
      }
    `];render(){let{actions:t,axes:n,homing:r}=this.catalog,i=t.includes(`change_speed`)||t.includes(`change_target`),a=n.length+2+ +(r.length>0)+ +!!i;return e`
      ${this.#e()}
      <div class="grid">
        ${n.map(t=>e`
          <pt-axis .axis=${t} ${this.given()}></pt-axis>`)}
        <pt-moves ${this.given()}></pt-moves>
        ${r.length>0?e`<pt-homing ${this.given()}></pt-homing>`:f}
        <pt-ramps ${this.given()}></pt-ramps>
        ${i?e`<pt-on-the-fly ${this.given()}></pt-on-the-fly>`:f}
        <pt-curves compact class="after-${a%4}-of-4 after-${a%3}-of-3" ${this.given()}></pt-curves>
      </div>
    `}#e(){let t=this.live.status;if(!t)return e`<p class="summary muted">Waiting for the first status…</p>`;let n=t.programs.flatMap(({state:e},t)=>e===`idle`?[]:[`program ${t} ${e}`]),r=Object.entries(t.axes).map(([e,t])=>`${e}: ${t.error??(t.speed===0?`standing`:`moving`)}`);return e`
      <div class="row summary">
        <span class="muted">device time <span class="mono">${a(t.seconds)}</span></span>
        ${n.map(t=>e`<span class="badge ${t.endsWith(`error`)?`error`:`busy`}">${t}</span>`)}
        ${t.alarms.map(t=>e`<strong class="error-text">⚠ ${t}</strong>`)}
      </div>
      <div class="visually-hidden" aria-live="polite">${r.join(`, `)}</div>
    `}};customElements.define(`pt-control`,T);